//! Solid angles, directional weights, pairs of surfaces and averages: against each other and against closed forms.

use super::super::aperture::{Aperture, aperture_average};
use super::super::polygon_in_cone::polygon_in_cone;
use super::super::{cone, directional, disc, exchange, point, polygon, sphere};
use super::close;
use crate::math::DVec3;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

#[test]
fn solid_angles_of_discs_agree_with_polygons_and_continue_over_the_rim() {
    for (radius, height, lateral) in [(1.0, 0.5, 0.4), (1.0, 0.5, 1.6), (1.0, 0.01, 0.99), (1.0, 1e-3, 1.001), (0.1, 30.0, 7.0)] {
        let count = 2000;
        let step = 2.0 * PI / f64::from(count);
        let r = radius * (step / step.sin()).sqrt();
        let at = |k: i32| DVec3::new(lateral + r * (f64::from(k) * step).cos(), r * (f64::from(k) * step).sin(), height);
        let centre = DVec3::new(lateral, 0.0, height);
        // Triangle = half a parallelogram only for small ones: use the corner formula on thin sectors.
        let sum: f64 = (0..count)
            .map(|k| {
                let (a, b, c) = (centre, at(k), at(k + 1));
                let (la, lb, lc) = (a.length(), b.length(), c.length());
                2.0 * a.dot(b.cross(c)).abs().atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
            })
            .sum();
        let value = point::disc_solid_angle(radius, height, lateral);
        assert!(close(value, sum, 2e-3 * 1e-3 + 1e-6 / height.min(1.0)), "{radius} {height} {lateral}: {value} {sum}");
    }
    let below = point::disc_solid_angle(1.0, 0.2, 1.0 - 1e-13);
    let above = point::disc_solid_angle(1.0, 0.2, 1.0 + 1e-13);
    assert!(close(below, above, 1e-10), "{below} {above}");
    assert!(close(point::disc_solid_angle(1.0, 2.0, 1e-12), point::disc_solid_angle(1.0, 2.0, 0.0), 1e-12));
}

#[test]
fn six_faces_of_a_box_fill_the_sphere() {
    for p in [DVec3::new(0.2, 0.3, -0.4), DVec3::new(0.99, -0.7, 0.9999)] {
        let mut sum = 0.0;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let (u, v) = (DVec3::new(axis.y, axis.z, axis.x), DVec3::new(axis.z, axis.x, axis.y));
            for side in [axis, -axis] {
                sum += point::parallelogram_solid_angle(side - u - v - p, 2.0 * u, 2.0 * v);
            }
        }
        assert!(close(sum, 4.0 * PI, 1e-14));
    }
}

#[test]
fn directional_weights_agree_between_table_function_and_closed_form() {
    // A hemisphere with R = cos^k θ: ∫ cos^k θ dG = 2π/(k + 2).
    let hemisphere = |theta: f64| cone::projected_solid_angle(theta);
    for k in [0, 1, 4, 40] {
        let result = directional::weighted_by_function(&hemisphere, &|t: f64| t.cos().powi(k), &[0.0, FRAC_PI_2], 1e-11);
        let expected = 2.0 * PI / f64::from(k + 2);
        assert!(close(result.value, expected, 1e-11), "{k}: {result:?} {expected}");
        assert!((result.value - expected).abs() <= result.error + 1e-15);
    }
    // A table with a step and a slope over an off-axis disc, against the same table as a function with breaks.
    let c = DVec3::new(0.4, 0.1, 1.0);
    let g = |theta: f64| disc::disc_in_cone(c, DVec3::Z, 0.3, DVec3::Z, theta);
    let table = [(0.0, 1.0), (0.3, 0.9), (0.4, 0.5), (0.4, 0.25), (1.0, 0.0)];
    let by_table = directional::weighted_by_table(&g, &table, &[], 1e-10);
    let smooth = |a: f64, b: f64, ra: f64, rb: f64| {
        directional::weighted_by_function(&g, &|t: f64| ra + (rb - ra) * (t - a) / (b - a), &[a, b], 1e-10).value
    };
    let by_parts = smooth(0.0, 0.3, 1.0, 0.9) + smooth(0.3, 0.4, 0.9, 0.5) + smooth(0.4, 1.0, 0.25, 0.0);
    assert!(close(by_table.value, by_parts, 1e-8), "{by_table:?} {by_parts}");
    // A response of 1 is no response.
    let whole = directional::weighted_by_table(&g, &[(0.0, 1.0), (1.5, 1.0)], &[], 1e-10);
    assert!(close(whole.value, g(FRAC_PI_2), 1e-12));
}

#[test]
fn exchange_is_reciprocal_additive_and_agrees_with_an_average() {
    let square = |z: f64, s: f64, dx: f64| [(-s, -s), (s, -s), (s, s), (-s, s)].map(|(x, y)| DVec3::new(x + dx, y, z));
    for (gap, s, dx) in [(1.0, 0.5, 0.0), (0.01, 0.7, 0.3), (1e4, 0.5, 1.0), (1e7, 1.0, 10.0), (3.0, 2.0, 5.0)] {
        let (a, b) = (square(0.0, 1.0, 0.0), square(gap, s, dx));
        let forward = exchange::polygons(&a, &b, 1e-9).unwrap();
        let back = exchange::polygons(&b, &a, 1e-9).unwrap();
        assert!(close(forward.value, back.value, 3e-9), "{gap}: {forward:?} {back:?}");
    }
    let (a, b) = (square(0.0, 1.0, 0.0), square(1.0, 0.5, 0.3));
    let aperture = Aperture::Parallelogram { corner: a[0], edge_u: a[1] - a[0], edge_v: a[3] - a[0] };
    let mean = aperture_average(aperture, &|x| polygon::polygon_two_sided(&b.map(|q| q - x), DVec3::Z), 1e-10).unwrap();
    assert!(close(4.0 * mean.value, exchange::polygons(&a, &b, 1e-10).unwrap().value, 1e-9));
}

#[test]
fn averages_over_a_disc_reproduce_coaxial_discs_and_give_up_on_noise() {
    for (r1, r2, h) in [(1.0, 0.5, 0.7), (2.0, 1.0, 0.2), (0.1, 0.3, 5.0)] {
        let aperture = Aperture::Disc { centre: DVec3::ZERO, radius_u: DVec3::X * r2, radius_v: DVec3::Y * r2 };
        let mean = aperture_average(aperture, &|x| disc::parallel_disc(h, x.length(), r1), 1e-11).unwrap();
        assert!(close(mean.value * PI * r2 * r2, exchange::coaxial_discs(r1, r2, h), 1e-10));
    }
    let noisy = |x: DVec3| (1e9 * x.x).sin().abs();
    let aperture = Aperture::Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(aperture_average(aperture, &noisy, 1e-9), None);
    let constant = aperture_average(aperture, &|_| 3.0, 1e-12).unwrap();
    assert!(close(constant.value, 3.0, 1e-14));
}

/// Numbers that meet: small integers, tiny and huge values.
fn awkward() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => (-2..=2_i32).prop_map(f64::from),
        1 => (-2..=2_i32).prop_map(|k| f64::from(k) * 1e-16),
        1 => (-2..=2_i32).prop_map(|k| f64::from(k) * 1e-200),
        1 => (-2..=2_i32).prop_map(|k| f64::from(k) * 1e150),
        1 => Just(f64::INFINITY),
    ]
}

fn awkward_vector() -> impl Strategy<Value = DVec3> {
    (awkward(), awkward(), awkward()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]

    #[test]
    fn awkward_numbers_give_values_between_zero_and_pi(a in awkward_vector(), b in awkward_vector(), c in awkward_vector(),
                                                      d in awkward_vector(), n in awkward_vector(), r in awkward(), beta in 0.0..1.6_f64) {
        for value in [
            polygon::polygon_two_sided(&[a, b, c], n),
            polygon::polygon_two_sided(&[a, b, c, d], n),
            polygon::polygon(&[a, b, c], n),
            polygon_in_cone(&[a, b, c], n, beta),
            polygon_in_cone(&[a, b, c, d], n, beta),
            disc::disc_two_sided(a, b, r, n),
            disc::disc_in_cone(a, b, r, n, beta),
            sphere::sphere(a, r, n),
            sphere::sphere_in_cone(a, r, n, beta),
            cone::half_space_in_cone(a, n, beta),
            0.25 * point::parallelogram_solid_angle(a, b, c),
            0.5 * point::disc_solid_angle(r, a.x, a.y),
        ] {
            prop_assert!((0.0..=PI * (1.0 + 1e-9)).contains(&value), "{value:e}");
        }
        prop_assert!(point::irradiance_factor(a, n) >= 0.0);
        prop_assert!(exchange::coaxial_discs(r, a.x, a.y) >= 0.0);
    }
}

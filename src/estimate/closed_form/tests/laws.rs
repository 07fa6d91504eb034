//! Laws that hold for every parameter, and agreement with forms that share no code.

use super::super::polygon_in_cone::polygon_in_cone;
use super::super::{cone, disc, point, polygon, sphere};
use super::close;
use crate::math::{DMat3, DVec3};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0_f64, 0.0..2.0 * PI).prop_map(|(z, phi)| {
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * phi.cos(), r * phi.sin(), z)
    })
}

fn position() -> impl Strategy<Value = DVec3> {
    (direction(), -1.5..1.5_f64).prop_map(|(d, log)| d * 10f64.powf(log))
}

fn rotation() -> impl Strategy<Value = DMat3> {
    (direction(), 0.0..2.0 * PI).prop_map(|(axis, angle)| DMat3::from_axis_angle(axis, angle))
}

/// `∫ max(0, ω·n) dΩ` over a disc by the midpoint rule in polar coordinates; accepts directions within `half_angle_rad` of n.
fn brute_force_disc(c: DVec3, m: DVec3, radius: f64, n: DVec3, half_angle_rad: f64) -> f64 {
    let u = m.any_orthonormal_vector();
    let v = m.cross(u);
    let steps = 1200;
    let mut sum = 0.0;
    for i in 0..steps {
        let r = radius * (i as f64 + 0.5) / steps as f64;
        for k in 0..steps {
            let (sin, cos) = (2.0 * PI * (k as f64 + 0.5) / steps as f64).sin_cos();
            let p = c + (u * cos + v * sin) * r;
            let cosine = p.dot(n) / p.length();
            if cosine > half_angle_rad.cos().max(0.0) {
                sum += r * cosine * p.dot(m).abs() / p.length().powi(3);
            }
        }
    }
    sum * radius / steps as f64 * 2.0 * PI / steps as f64
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]

    #[test]
    fn turning_everything_changes_nothing(c in position(), m in direction(), n in direction(), r in 0.01..3.0_f64,
                                          turn in rotation(), beta in 0.05..1.5_f64) {
        let whole = disc::disc_two_sided(c, m, r, n);
        let floor = 1e-12 * whole.max(1e-12);
        prop_assert!((whole - disc::disc_two_sided(turn * c, turn * m, r, turn * n)).abs() <= 1e-9 * whole + floor);
        let part = disc::disc_in_cone(c, m, r, n, beta);
        prop_assert!((part - disc::disc_in_cone(turn * c, turn * m, r, turn * n, beta)).abs() <= 1e-9 * whole + floor);
        prop_assert!(part <= whole * (1.0 + 1e-10) + floor);
    }

    #[test]
    fn scale_changes_nothing(c in position(), m in direction(), n in direction(), r in 0.01..3.0_f64, log in -30.0..30.0_f64) {
        let s = 2f64.powf((log * 3.32).round());
        prop_assert_eq!(disc::disc_two_sided(c, m, r, n), disc::disc_two_sided(c * s, m, r * s, n * s));
        prop_assert_eq!(sphere::sphere(c, r, n), sphere::sphere(c * s, r * s, n * s));
        let corners = [c, c + m, c + n];
        let large = corners.map(|v| v * s);
        prop_assert_eq!(polygon::polygon_two_sided(&corners, n), polygon::polygon_two_sided(&large, n));
    }

    #[test]
    fn opposite_elements_differ_by_the_flux_vector(c in position(), m in direction(), n in direction(), r in 0.01..3.0_f64) {
        // The flux vector from three perpendicular pairs of elements.
        let net = |n: DVec3| disc::disc_two_sided(c, m, r, n) - disc::disc_two_sided(c, m, r, -n);
        let vector = DVec3::new(net(DVec3::X), net(DVec3::Y), net(DVec3::Z));
        prop_assert!((net(n) - vector.dot(n)).abs() <= 1e-10 * vector.length());
        if c.length() > r {
            let net = sphere::sphere(c, r, n) - sphere::sphere(c, r, -n);
            let expected = PI * (r / c.length()).powi(2) * n.dot(c) / c.length();
            prop_assert!((net - expected).abs() <= 1e-12 * PI * (r / c.length()).powi(2));
        }
        let corners = [c, c + m, c + n.cross(m) + m];
        let net = |n: DVec3| polygon::polygon_two_sided(&corners, n) - polygon::polygon_two_sided(&corners, -n);
        let vector = DVec3::new(net(DVec3::X), net(DVec3::Y), net(DVec3::Z));
        prop_assert!((net(n) - vector.dot(n)).abs() <= 1e-9 * vector.length());
    }

    #[test]
    fn parts_of_a_polygon_add_up(a in position(), b in position(), d in position(), n in direction(), split in 0.1..0.9_f64,
                                 beta in 0.1..1.5_f64) {
        let p = a + (b - a) * split;
        let whole = polygon::polygon_two_sided(&[a, b, d], n);
        let parts = polygon::polygon_two_sided(&[a, p, d], n) + polygon::polygon_two_sided(&[p, b, d], n);
        prop_assert!((whole - parts).abs() <= 1e-9 * whole + 1e-15, "{whole:e} {parts:e}");
        let accepted = polygon_in_cone(&[a, b, d], n, beta);
        let parts = polygon_in_cone(&[a, p, d], n, beta) + polygon_in_cone(&[p, b, d], n, beta);
        prop_assert!((accepted - parts).abs() <= 1e-9 * accepted + 1e-14 * whole, "{accepted:e} {parts:e}");
        prop_assert!(accepted <= whole * (1.0 + 1e-9) + 1e-15);
    }

    #[test]
    fn a_right_angled_cone_is_no_cone(c in position(), m in direction(), n in direction(), r in 0.01..3.0_f64) {
        let nearly = FRAC_PI_2 * (1.0 - 1e-12);
        for (whole, accepted) in [
            (disc::disc_two_sided(c, m, r, n), disc::disc_in_cone(c, m, r, n, nearly)),
            (sphere::sphere(c, r, n), sphere::sphere_in_cone(c, r, n, nearly)),
            (polygon::polygon_two_sided(&[c, c + m, c + n], n), polygon_in_cone(&[c, c + m, c + n], n, nearly)),
        ] {
            prop_assert!((whole - accepted).abs() <= 1e-10 * whole + 1e-20, "{whole:e} {accepted:e}");
        }
    }

    #[test]
    fn a_sphere_is_seen_as_its_disc_of_contact(c in position(), n in direction(), fraction in 0.001..0.999_f64) {
        let d = c.length();
        let r = fraction * d;
        let axis = c / d;
        let (sin, cos) = (fraction, ((1.0 - fraction) * (1.0 + fraction)).sqrt());
        let as_disc = disc::disc_two_sided(axis * cos, axis, sin, n);
        let value = sphere::sphere(c, r, n);
        prop_assert!((value - as_disc).abs() <= 1e-9 * value + 1e-14 * sin * sin, "{value:e} {as_disc:e}");
    }

    #[test]
    fn caps_and_cones_may_change_places(alpha in 0.01..1.5_f64, beta in 0.01..1.5_f64, tilt in 0.0..3.0_f64) {
        // Both are circles on the sphere of directions: what is in the cap and in the cone plus what is in the cap only is the cap.
        let both = sphere::cap_in_cone(alpha, tilt, beta);
        prop_assert!(both <= sphere::cap(alpha, tilt) * (1.0 + 1e-10) + 1e-17);
        prop_assert!(both <= cone::projected_solid_angle(beta) * (1.0 + 1e-10));
        if tilt + alpha <= beta {
            prop_assert!(close(both, PI * alpha.sin().powi(2) * tilt.cos(), 1e-11));
        }
        if tilt + beta <= alpha {
            prop_assert!(close(both, PI * beta.sin().powi(2), 1e-11));
        }
        if tilt >= alpha + beta {
            prop_assert!(both <= 1e-14);
        }
    }

    #[test]
    fn many_corners_make_a_disc(c in position(), m in direction(), n in direction(), r in 0.05..2.0_f64, beta in 0.2..1.4_f64) {
        let u = m.any_orthonormal_vector();
        let v = m.cross(u);
        let corners = |count: usize| -> Vec<DVec3> {
            // The radius that gives the polygon the area of the disc.
            let step = 2.0 * PI / count as f64;
            let radius = r * (step / step.sin()).sqrt();
            (0..count).map(|k| (k as f64 * step).sin_cos()).map(|(s, co)| c + (u * co + v * s) * radius).collect()
        };
        let (whole, accepted) = (disc::disc_two_sided(c, m, r, n), disc::disc_in_cone(c, m, r, n, beta));
        prop_assert!((polygon::polygon_two_sided(&corners(400), n) - whole).abs() <= 1e-3 * whole + 1e-5);
        prop_assert!((polygon_in_cone(&corners(400), n, beta) - accepted).abs() <= 1e-3 * whole + 1e-5);
    }
}

#[test]
fn discs_agree_with_a_plain_sum() {
    for (c, m, r, n, beta) in [
        (DVec3::new(0.3, -0.2, 0.7), DVec3::new(0.5, 0.2, 1.0), 0.9, DVec3::new(1.0, 0.2, 0.1), FRAC_PI_2),
        (DVec3::new(1.3, 0.2, 0.7), DVec3::new(-0.5, 0.2, 1.0), 0.9, DVec3::new(0.1, 0.2, 1.0), 0.8),
        (DVec3::new(0.1, 0.0, 0.7), DVec3::new(-0.5, 0.2, 1.0), 1.9, DVec3::new(0.3, 0.2, 1.0), 1.2),
        (DVec3::new(1.5, 0.5, 0.1), DVec3::new(1.0, 0.0, 0.1), 1.0, DVec3::new(0.3, 0.2, 1.0), 1.4),
    ] {
        let (m, n) = (m.normalize(), n.normalize());
        let expected = brute_force_disc(c, m, r, n, beta);
        let value = disc::disc_in_cone(c, m, r, n, beta);
        assert!(close(value, expected, 3e-4), "{value} {expected}");
    }
}

#[test]
fn caps_agree_with_a_sum_over_polar_angle() {
    for (alpha, tilt) in [(0.5, 1.3_f64), (0.5, 1.9), (0.02, 1.58), (1.4, 2.2), (1.4, 0.4), (1.5, 3.0), (0.9, 2.4), (2.0, 2.9)] {
        let steps = 400_000;
        let mut sum = 0.0;
        for k in 0..steps {
            let theta = (k as f64 + 0.5) * FRAC_PI_2 / f64::from(steps);
            let cosine = (f64::cos(alpha) - theta.cos() * tilt.cos()) / (theta.sin() * tilt.sin());
            sum += 2.0 * cosine.clamp(-1.0, 1.0).acos() * theta.sin() * theta.cos() * FRAC_PI_2 / f64::from(steps);
        }
        let value = sphere::cap(alpha, tilt);
        assert!(close(value, sum, 1e-5), "{alpha} {tilt}: {value} {sum}");
    }
}

#[test]
fn a_sliver_of_a_sunk_sphere_keeps_its_digits() {
    // G ≈ (2/15) τ⁵ (1 − s²)/s² for a cap that rises above the horizon by a very small angle, Q² = sin(α + e) sin(α − e).
    for alpha in [0.01_f64, 0.5, 1.2] {
        for rise in [1e-7_f64, 1e-5] {
            let value = sphere::cap(alpha, FRAC_PI_2 + alpha * (1.0 - rise));
            let s = (alpha * (1.0 - rise)).sin();
            let tau = ((alpha * rise).sin() * (2.0 * alpha).sin()).sqrt() / alpha.cos();
            let expected = 2.0 / 15.0 * tau.powi(5) * (1.0 - s * s) / (s * s);
            assert!(close(value, expected, 20.0 * rise + 1e-7), "{alpha} {rise}: {value:e} {expected:e}");
        }
    }
}

#[test]
fn far_and_grazing_polygons_approach_the_point_law() {
    for (size, tilt) in [(1e-3, 0.3), (1e-6, 0.3), (1e-9, 1e-6), (1e-5, 1e-4), (1e-12, 1.0)] {
        let n = DVec3::new(f64::sin(0.2), 0.0, f64::cos(0.2));
        let m = DVec3::new(-f64::sin(tilt), 0.0, f64::cos(tilt));
        let (u, v) = (DVec3::Y, m.cross(DVec3::Y));
        let centre = DVec3::new(1.0, 0.25, 0.0);
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| centre + (u * a + v * b) * size);
        let value = polygon::polygon_two_sided(&corners, n);
        let r = centre.length();
        let expected = 4.0 * size * size * centre.dot(n) * centre.dot(m).abs() / r.powi(4);
        assert!(close(value, expected, 10.0 * size + 1e-15 / size), "{size} {tilt}: {value:e} {expected:e}");
    }
}

#[test]
fn degenerate_sources_give_nothing_and_never_nan() {
    let z = DVec3::Z;
    assert_eq!(polygon::polygon_two_sided(&[DVec3::ZERO; 3], z), 0.0);
    assert_eq!(polygon::polygon_two_sided(&[z; 3], z), 0.0);
    assert_eq!(polygon::polygon_two_sided(&[z, z + DVec3::X, z + 2.0 * DVec3::X], z), 0.0);
    assert_eq!(polygon::polygon_two_sided(&[-z, DVec3::X - z, DVec3::Y - z], z), 0.0);
    assert_eq!(polygon::polygon_two_sided(&[DVec3::NAN, DVec3::X, DVec3::Y], z), 0.0);
    assert_eq!(polygon_in_cone(&[z, DVec3::X, DVec3::Y], z, 0.0), 0.0);
    assert_eq!(disc::disc(-z, z, 1.0, z), 0.0);
    assert_eq!(disc::disc(z, z, 1.0, z), 0.0);
    assert_eq!(disc::disc(z, -z, 0.0, z), 0.0);
    assert_eq!(disc::disc(z, DVec3::ZERO, 1.0, z), 0.0);
    assert_eq!(sphere::sphere(-2.0 * z, 1.0, z), 0.0);
    assert_eq!(point::irradiance_factor(-z, z), 0.0);
    assert_eq!(point::irradiance_factor(DVec3::ZERO, z), 0.0);
    assert_eq!(point::irradiance_factor(DVec3::X * 1e200, DVec3::X * 1e-200), 0.0);
    assert!(close(point::irradiance_factor(z * 1e-150, z * 1e200), 1e300, 1e-12));
    assert_eq!(sphere::cap(f64::NAN, 0.1), 0.0);
}

#[test]
fn an_element_on_a_large_emitter_receives_pi() {
    let z = DVec3::Z;
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    for height in [0.0, 1e-9] {
        let corners: Vec<DVec3> = square.iter().rev().map(|&(x, y)| DVec3::new(x, y, height)).collect();
        assert!(close(polygon::polygon(&corners, z), PI, 1e-8));
        assert!(close(disc::disc(z * height, -z, 1.0, z), PI, 1e-8));
        assert!(close(polygon_in_cone(&corners, z, 0.5), PI * f64::sin(0.5).powi(2), 1e-12));
        let tilted = DVec3::new(1.0, 0.0, 1.0);
        let half_sunk = FRAC_PI_2 * (1.0 + f64::sqrt(0.5));
        assert!(close(polygon::polygon(&corners, tilted), half_sunk, 1e-8));
        assert!(close(disc::disc(z * height, -z, 1.0, tilted), half_sunk, 1e-8));
    }
    assert!(close(sphere::sphere(z, 1.0, tilted_by(0.7)), FRAC_PI_2 * (1.0 + f64::cos(0.7)), 1e-7));
}

fn tilted_by(angle: f64) -> DVec3 {
    DVec3::new(angle.sin(), 0.0, angle.cos())
}

#[test]
fn caps_in_cones_agree_with_a_sum_over_polar_angle() {
    for (alpha, tilt, beta) in [(0.3, 0.5_f64, 0.4), (0.9, 0.2, 0.8), (0.05, 0.1, 0.08), (1.3, 1.5, 1.2)] {
        let steps = 400_000;
        let mut sum = 0.0;
        for k in 0..steps {
            let theta = (k as f64 + 0.5) * beta / f64::from(steps);
            let cosine = (f64::cos(alpha) - theta.cos() * tilt.cos()) / (theta.sin() * tilt.sin());
            sum += 2.0 * cosine.clamp(-1.0, 1.0).acos() * theta.sin() * theta.cos();
        }
        sum *= beta / f64::from(steps);
        let value = sphere::cap_in_cone(alpha, tilt, beta);
        assert!(close(value, sum, 1e-6), "{alpha} {tilt}: {value} {sum}");
    }
}

#[test]
fn a_disc_cut_by_the_horizon_agrees_with_its_contour() {
    for (c, t, r) in
        [(DVec3::new(0.1, 0.3, 0.2), 1.4_f64, 1.0), (DVec3::new(0.0, 0.0, 1e-3), 1.0, 0.5), (DVec3::new(3.0, -1.0, 1.0), 1.9, 2.7)]
    {
        let n = tilted_by(t);
        // The chord is parallel to y, the arc runs over |ψ| < end with x = r cos ψ.
        let end = (-n.dot(c) / (r * t.sin())).acos();
        let rim = |psi: f64| c + DVec3::new(r * psi.cos(), r * psi.sin(), 0.0);
        let steps = 2_000_000;
        let mut arc = 0.0;
        for k in 0..steps {
            let psi = end * (2.0 * (f64::from(k) + 0.5) / f64::from(steps) - 1.0);
            let p = rim(psi);
            let tangent = DVec3::new(-r * psi.sin(), r * psi.cos(), 0.0);
            arc += n.dot(p.cross(tangent)) / p.length_squared() * 2.0 * end / f64::from(steps);
        }
        let (a, b) = (rim(end), rim(-end));
        let w = a.cross(b);
        let chord = w.length().atan2(a.dot(b)) * w.dot(n) / w.length();
        let expected = 0.5 * (arc + chord);
        let value = disc::disc(c, -DVec3::Z, r, n);
        assert!(close(value, expected, 1e-9), "{value} {expected}");
    }
}

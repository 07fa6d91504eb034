//! Two standing tests for every sampler: the inverse undoes the sample, and a χ² of samples against the density.

use proptest::prelude::*;

use super::*;
use crate::math::DVec3;
use crate::math::angle::one_minus_cos;
use crate::math::random::Stream;

fn close(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
}

proptest! {
    #[test]
    fn inverses_undo_samples(u in 0.001..0.999_f64, v in 0.001..0.999_f64, half_angle in 1e-4..1.5_f64) {
        prop_assert!(close(invert_disc(sample_disc([u, v])), [u, v]));
        let sine = half_angle.sin();
        prop_assert!(close(invert_cosine_cone(sample_cosine_cone([u, v], sine), sine), [u, v]));
        let h = one_minus_cos(2.0 * half_angle);
        prop_assert!(close(invert_cone(sample_cone([u, v], h), h), [u, v]));
        prop_assert!(close(invert_triangle(sample_triangle([u, v])), [u, v]));
    }

    #[test]
    fn cones_of_any_width_hold_their_samples(u in 0.0..1.0_f64, v in 0.0..1.0_f64, exponent in -12.0..0.0_f64) {
        let a = 10f64.powf(exponent);
        let d = sample_cone([u, v], one_minus_cos(a));
        prop_assert!((d.length() - 1.0).abs() < 1e-15);
        prop_assert!(d.x.hypot(d.y).atan2(d.z) <= a * (1.0 + 1e-9));
    }
}

/// Pearson's χ² of samples counted in cells whose probabilities follow from the density.
///
/// One number from each of many streams: independent numbers, for which χ² has its textbook distribution.
fn counts_follow(expected: impl Fn(usize, usize) -> f64, cell: impl Fn([f64; 2]) -> (usize, usize), cells: (usize, usize)) {
    let n = 200_000;
    let mut counts = vec![0.0; cells.0 * cells.1];
    for i in 0..n {
        let u = Stream::new(11, &[i]).four(0, 0);
        let (a, b) = cell([u[0], u[1]]);
        counts[a.min(cells.0 - 1) * cells.1 + b.min(cells.1 - 1)] += 1.0;
    }
    let total = n as f64;
    let mut sum = 0.0;
    for a in 0..cells.0 {
        for b in 0..cells.1 {
            let e = expected(a, b) * total;
            assert!(e > 20.0, "cell {a}, {b} expects {e} samples");
            sum += (counts[a * cells.1 + b] - e).powi(2) / e;
        }
    }
    let freedom = (cells.0 * cells.1 - 1) as f64;
    assert!(sum < freedom + 3.0 * (2.0 * freedom).sqrt(), "χ² = {sum} at {freedom} degrees of freedom");
}

fn azimuth(d: DVec3, cells: usize) -> usize {
    (((d.y.atan2(d.x) / std::f64::consts::TAU).rem_euclid(1.0)) * cells as f64) as usize
}

#[test]
fn the_cosine_hemisphere_has_its_density() {
    // The share of a ring between sin² = a and b is b − a.
    let pdf_sum = |k: usize| {
        let (a, b) = (k as f64 / 8.0, (k + 1) as f64 / 8.0);
        let steps = 2000;
        (0..steps)
            .map(|i| {
                let s2 = a + (b - a) * (i as f64 + 0.5) / f64::from(steps);
                let d = DVec3::new(s2.sqrt(), 0.0, (1.0 - s2).sqrt());
                // dω = sinθ dθ dφ = d(sin²)/(2 cosθ) dφ
                cosine_cone_pdf(d, 1.0) / (2.0 * d.z) * std::f64::consts::TAU * (b - a) / f64::from(steps)
            })
            .sum::<f64>()
    };
    counts_follow(
        |k, _| pdf_sum(k) / 12.0,
        |u| {
            let d = sample_cosine_hemisphere(u);
            (((d.x * d.x + d.y * d.y) * 8.0) as usize, azimuth(d, 12))
        },
        (8, 12),
    );
}

#[test]
fn the_uniform_cone_has_its_density() {
    let h = one_minus_cos(0.7);
    counts_follow(
        |_, _| cone_pdf(h) * std::f64::consts::TAU * h / 8.0 / 12.0,
        |u| {
            let d = sample_cone(u, h);
            (((1.0 - d.z) / h * 8.0) as usize, azimuth(d, 12))
        },
        (8, 12),
    );
}

#[test]
fn the_triangle_has_its_density() {
    // Four similar quarters of a triangle have equal areas: ½ · density · ¼.
    counts_follow(
        |_, _| 0.5 * triangle_pdf() / 4.0,
        |u| {
            let b = sample_triangle(u);
            (b.iter().position(|&x| x > 0.5).unwrap_or(3), 0)
        },
        (4, 1),
    );
}

#[test]
fn the_disc_has_its_density() {
    counts_follow(
        |_, _| disc_pdf() * std::f64::consts::PI / 8.0 / 12.0,
        |u| {
            let p = sample_disc(u);
            (((p[0] * p[0] + p[1] * p[1]) * 8.0) as usize, azimuth(DVec3::new(p[0], p[1], 0.0), 12))
        },
        (8, 12),
    );
}

//! Frames against the closed forms and the exact distribution, with fixed seeds.

use super::*;
use crate::metrology::Moments;
use crate::metrology::distribution::chi_squared_quantile;
use proptest::prelude::*;

fn camera() -> Pixel {
    Pixel { dark_current_e_s: 30.0, read_noise_e: 8.0, dsnu_e: 3.0, prnu: 0.008, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) }
}

/// χ² of the digital numbers of many pixels without fixed pattern against their distribution, with its degrees of freedom.
fn chi_squared(pixel: &Pixel, electrons: f32, exposure_s: f64, seed: u64) -> (f64, f64) {
    let pixel = Pixel { dsnu_e: 0.0, prnu: 0.0, ..*pixel };
    const PIXELS: usize = 200_000;
    let frame = pixel.expose(&vec![electrons; PIXELS], exposure_s, pixel.reference_temperature_c, seed, 5);
    let codes = pixel.linear(exposure_s, pixel.reference_temperature_c).codes(f64::from(electrons));
    let mut counts = vec![0u32; 1 << 16];
    frame.iter().for_each(|y| counts[usize::from(*y)] += 1);
    let (mut sum, mut bins, mut expected, mut found, mut seen) = (0.0, 0.0, 0.0, 0.0, 0);
    for (i, p) in codes.probabilities.iter().enumerate() {
        let count = counts[usize::from(codes.first_dn) + i];
        seen += count as usize;
        (expected, found) = (expected + p * PIXELS as f64, found + f64::from(count));
        if expected >= 100.0 {
            sum += (found - expected).powi(2) / expected;
            (bins, expected, found) = (bins + 1.0, 0.0, 0.0);
        }
    }
    assert_eq!(seen, PIXELS, "digital numbers that have no probability");
    (sum, bins - 1.0)
}

/// From darkness to far above saturation; noise of many digital numbers and of a fraction of one.
#[test]
fn digital_numbers_follow_their_exact_distribution() {
    let coarse = Pixel { read_noise_e: 4.0, dark_current_e_s: 10.0, ..Pixel::ideal(0.02, 9000.0, 8.0, 8) };
    let cut_off = Pixel { read_noise_e: 20.0, ..Pixel::ideal(1.0, 5000.0, 3.0, 10) };
    let mut sum = (0.0, 0.0);
    for (pixel, electrons) in [(camera(), [0.0, 5.0, 900.0, 13_700.0, 14_050.0]), (coarse, [0.0, 26.0, 800.0, 8_900.0, 20_000.0])]
        .into_iter()
        .chain([(cut_off, [0.0, 12.0, 500.0, 1000.0, 1200.0])])
    {
        for (i, electrons) in electrons.into_iter().enumerate() {
            let (found, dof) = chi_squared(&pixel, electrons, 0.01, i as u64);
            if dof >= 1.0 {
                let high = chi_squared_quantile(1.0 - 1e-4, dof).unwrap();
                assert!(found < high, "{electrons} e⁻ of {pixel:?}: χ² {found} of {dof}, at most {high}");
                sum = (sum.0 + found, sum.1 + dof);
            }
        }
    }
    // Neither too well.
    assert!(sum.1 > 500.0 && sum.0 > chi_squared_quantile(1e-4, sum.1).unwrap(), "{sum:?}");
}

/// Temporal variance = gain × mean + read noise, over the whole range, with the fixed pattern on.
#[test]
fn variance_is_gain_times_mean_plus_read_noise() {
    let pixel = camera();
    let model = pixel.linear(0.01, 20.0);
    const PIXELS: usize = 100_000;
    let mut sum = 0.0;
    let levels: Vec<f64> = (0..24).map(|i| 13_400.0 * f64::from(i) / 24.0).collect();
    for (i, &electrons) in levels.iter().enumerate() {
        let expose = |frame: u64| pixel.expose(&[electrons as f32; PIXELS], 0.01, 20.0, 7, 2 * i as u64 + frame);
        let (a, b) = (expose(0), expose(1));
        // The difference of two frames has no fixed pattern and twice the variance.
        let differences: Moments = a.iter().zip(&b).map(|(a, b)| f64::from(*a) - f64::from(*b)).collect();
        let expected = model.variance_dn2(electrons);
        let u = expected * (2.0 / PIXELS as f64).sqrt();
        let deviation = (0.5 * differences.variance().unwrap() - expected) / u;
        assert!(deviation.abs() < 4.5, "{electrons} e⁻: {deviation} u");
        sum += deviation * deviation;
    }
    let dof = levels.len() as f64;
    assert!(sum < chi_squared_quantile(1.0 - 1e-4, dof).unwrap() && sum > chi_squared_quantile(1e-4, dof).unwrap(), "{sum}");
}

#[test]
fn the_pattern_has_its_dsnu_and_prnu_and_stays_from_frame_to_frame() {
    let pixel = camera();
    let patterns = (0..100_000).map(|i| pixel.pattern(3, i));
    let (mut gain, mut offset) = (Moments::new(), Moments::new());
    for pattern in patterns {
        gain.push(pattern.responsivity);
        offset.push(pattern.offset_e);
    }
    let relative = 1.0 / (2.0 * 1e5f64).sqrt();
    assert!((gain.standard_deviation().unwrap() / 0.008 - 1.0).abs() < 4.0 * relative);
    assert!((offset.standard_deviation().unwrap() / 3.0 - 1.0).abs() < 4.0 * relative);
    assert!((gain.mean().unwrap() - 1.0).abs() < 4.0 * 0.008 / 316.0 && offset.mean().unwrap().abs() < 4.0 * 3.0 / 316.0);
    assert_ne!(pixel.pattern(3, 5), pixel.pattern(4, 5));
    // The covariance of two frames is that of the pattern: PRNU μ_e and DSNU.
    let electrons = [6000.0f32; 60_000];
    let (a, b) = (pixel.expose(&electrons, 0.0, 20.0, 3, 0), pixel.expose(&electrons, 0.0, 20.0, 3, 1));
    let mean = |frame: &[u16]| frame.iter().map(|y| f64::from(*y)).sum::<f64>() / 6e4;
    let (mean_a, mean_b) = (mean(&a), mean(&b));
    let covariance = a.iter().zip(&b).map(|(a, b)| (f64::from(*a) - mean_a) * (f64::from(*b) - mean_b)).sum::<f64>() / 6e4;
    let pattern = 0.0625 * (9.0 + (0.008f64 * 6000.0).powi(2));
    let variance = pattern + pixel.variance_dn2(6000.0, 0.0, 20.0);
    let u = (variance * variance + pattern * pattern).sqrt() / 6e4f64.sqrt();
    assert!((covariance - pattern).abs() < 4.0 * u, "{covariance} {pattern} {u}");
}

#[test]
fn no_light_with_much_noise_stays_at_or_above_zero_and_no_number_is_no_light() {
    let pixel = Pixel { read_noise_e: 100.0, dsnu_e: 50.0, prnu: 2.0, ..Pixel::ideal(1.0, 1000.0, 0.0, 8) };
    let frame = pixel.expose(&[0.0; 10_000], 0.0, 20.0, 1, 0);
    let zeros = frame.iter().filter(|y| **y == 0).count();
    assert!((4800..5300).contains(&zeros) && frame.iter().all(|y| *y <= 255), "{zeros}");
    let ideal = Pixel::ideal(1.0, 1000.0, 5.0, 10);
    assert_eq!(ideal.expose(&[f32::NAN, -1.0, f32::INFINITY, f32::MAX, 1e16], 0.0, 20.0, 1, 0), [5, 5, 1005, 1005, 1005]);
    assert!(ideal.expose(&[], 0.0, 20.0, 1, 0).is_empty());
}

proptest! {
    #[test]
    fn a_frame_is_its_parts_in_any_order(cut in 0usize..2000, seed in any::<u64>(), frame in any::<u64>()) {
        let electrons: Vec<f32> = (0..2000u16).map(|i| f32::from(i) * 8.0).collect();
        let of = Exposure { exposure_s: 0.1, temperature_c: 30.0, seed, frame };
        let whole = camera().expose(&electrons, of.exposure_s, of.temperature_c, seed, frame);
        let mut parts = vec![0; 2000];
        let (left, right) = parts.split_at_mut(cut);
        camera().expose_part(&of, cut as u64, &electrons[cut..], right);
        camera().expose_part(&of, 0, &electrons[..cut], left);
        prop_assert_eq!(parts, whole);
    }

    #[test]
    fn the_mean_of_a_frame_is_that_of_its_distribution(
        gain in 0.01..4.0f64, noise in 0.0..30.0f64, electrons in 0.0..40_000.0f64, bits in 6u32..=16, well in 100.0..30_000.0f64
    ) {
        let pixel = Pixel { read_noise_e: noise, dark_current_e_s: 40.0, ..Pixel::ideal(gain, well, 10.0, bits) };
        const PIXELS: usize = 4000;
        let frame = pixel.expose(&[electrons as f32; PIXELS], 0.2, 25.0, 11, 0);
        let codes = pixel.linear(0.2, 25.0).codes(f64::from(electrons as f32));
        let found: Moments = frame.iter().map(|y| f64::from(*y)).collect();
        let u = (codes.variance_dn2() / PIXELS as f64).sqrt();
        // One in 1e-7 a case; where the distribution is nearly one number, its rare neighbours are not normal: a few of them.
        prop_assert!((found.mean().unwrap() - codes.mean_dn()).abs() <= 5.5 * u + 5.0 / PIXELS as f64, "{:?} {}", found.mean(), codes.mean_dn());
    }
}

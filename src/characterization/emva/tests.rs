//! What is put into a camera comes out of its frames, within the stated uncertainty.

use super::*;
use crate::metrology::distribution::chi_squared_quantile;
use crate::sensor::Pixel;

const EFFICIENCY: f64 = 0.6;
const PHOTONS_PER_S: f64 = 1e6;

fn camera() -> Pixel {
    Pixel { dark_current_e_s: 300.0, read_noise_e: 8.0, dsnu_e: 3.0, prnu: 0.008, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) }
}

fn measured(pixel: &Pixel, series: &Series, seed: u64) -> Result<Figures, EmvaError> {
    photon_transfer(series, &mut |shot, frame| {
        let electrons = vec![(EFFICIENCY * shot.photons) as f32; frame.len()];
        frame.copy_from_slice(&pixel.expose(&electrons, shot.exposure_s, pixel.reference_temperature_c, seed, shot.number));
        Ok(())
    })
}

fn by_time(pixel: &Pixel, side: usize) -> Series {
    let hard_e = pixel.linear(0.0, pixel.reference_temperature_c).hard_limit_e();
    Series::by_exposure_time(side, side, PHOTONS_PER_S, 1.04 * hard_e / (EFFICIENCY * PHOTONS_PER_S), 40, 24)
}

/// (key, what was put in).
fn truths(pixel: &Pixel) -> Vec<(&'static str, f64)> {
    let still = pixel.linear(0.0, pixel.reference_temperature_c);
    vec![
        ("gain_dn_per_e", pixel.gain_dn_per_e),
        ("quantum_efficiency", EFFICIENCY),
        ("responsivity_dn_per_photon", pixel.gain_dn_per_e * EFFICIENCY),
        ("dark_noise_dn", still.variance_dn2(0.0).sqrt()),
        ("dark_noise_e", pixel.read_noise_e),
        ("dark_current_e_s", pixel.dark_current_e_s),
        ("dark_current_by_variance_e_s", pixel.dark_current_e_s),
        ("threshold_e", still.threshold_e()),
        ("threshold_photons", still.threshold_photons(EFFICIENCY)),
        ("dsnu_e", pixel.dsnu_e),
        ("prnu", pixel.prnu),
    ]
}

/// Over seeds: χ² of (found − put in)/u for each figure, neither too large nor too small.
#[test]
fn what_is_put_in_comes_out_within_its_uncertainty() {
    let pixel = camera();
    let series = by_time(&pixel, 64);
    const SEEDS: u64 = 16;
    let sheets: Vec<Figures> = (0..SEEDS).map(|seed| measured(&pixel, &series, 100 + seed).unwrap()).collect();
    let low = chi_squared_quantile(2e-5, SEEDS as f64).unwrap();
    let high = chi_squared_quantile(1.0 - 2e-5, SEEDS as f64).unwrap();
    for (key, truth) in truths(&pixel) {
        let deviations = sheets.iter().map(|sheet| sheet.get(key).unwrap()).map(|f| (f.value - truth) / f.standard_uncertainty);
        let chi_squared: f64 = deviations.map(|d| d * d).sum();
        assert!((low..high).contains(&chi_squared), "{key}: χ² {chi_squared} of {SEEDS}, {low} … {high}");
    }
    for sheet in &sheets {
        // The pattern smears the peak of the variance over the pixels: it lies below that of one pixel, by less than its width.
        let found = sheet.get("saturation_e").unwrap();
        let peak = pixel.linear(sheet.points[sheet.saturation].level.exposure_s, 20.0).saturation_e();
        assert!((found.value - peak).abs() < 3.0 * found.standard_uncertainty, "{found:?} {peak}");
        let snr = sheet.get("largest_snr").unwrap();
        assert!(
            (snr.value - found.value.sqrt()).abs() < 1e-9 && sheet.list.iter().all(|f| f.note.is_none() || f.key.starts_with("linearity"))
        );
        for key in ["linearity_error_min", "linearity_error_max"] {
            let error = sheet.get(key).unwrap();
            assert!(error.value.abs() < 5.0 * error.standard_uncertainty && error.value.abs() < 2e-3, "{error:?}");
        }
        for split in [sheet.dark.split, sheet.bright.split] {
            assert!(split.column.abs() < 0.2 * split.pixel && split.row.abs() < 0.2 * split.pixel, "{split:?}");
        }
    }
}

#[test]
fn light_that_is_varied_at_one_exposure_time_gives_the_same_figures() {
    let pixel = Pixel { dark_current_e_s: 0.0, ..camera() };
    let mut series = by_time(&pixel, 64);
    series.levels.iter_mut().for_each(|level| level.exposure_s = 0.01);
    let mut darks = 0;
    let found = photon_transfer(&series, &mut |shot, frame| {
        darks += u32::from(shot.photons == 0.0 && !shot.of_stack);
        frame.copy_from_slice(&pixel.expose(&vec![(EFFICIENCY * shot.photons) as f32; frame.len()], 0.01, 20.0, 5, shot.number));
        Ok(())
    })
    .unwrap();
    assert_eq!((darks, found.get("dark_current_e_s")), (2, None));
    for (key, truth) in truths(&pixel).into_iter().filter(|(key, _)| !key.starts_with("dark_current")) {
        let figure = found.get(key).unwrap();
        assert!((figure.value - truth).abs() < 4.0 * figure.standard_uncertainty, "{figure:?} {truth}");
    }
}

#[test]
fn noise_below_a_digital_number_is_marked() {
    let pixel = Pixel { read_noise_e: 4.0, dsnu_e: 30.0, ..Pixel::ideal(0.02, 9000.0, 8.0, 8) };
    let found = measured(&pixel, &by_time(&pixel, 32), 1).unwrap();
    assert!(found.get("dark_noise_e").unwrap().note.is_some_and(|note| note.contains("0.24 DN²")));
}

#[test]
fn a_series_that_cannot_be_measured_says_why() {
    let pixel = camera();
    let words = |series: &Series| measured(&pixel, series, 1).unwrap_err().to_string();
    let good = by_time(&pixel, 16);
    assert!(words(&Series { rows: 2, ..good.clone() }).contains("16 × 2 pixels are too small"));
    assert!(words(&Series { levels: good.levels[..5].to_vec(), stack_level: 1, ..good.clone() }).contains("5 levels are too few"));
    assert!(words(&Series { stack_frames: 1, ..good.clone() }).contains("2 to 65536 frames"));
    assert!(words(&Series { stack_level: 40, ..good.clone() }).contains("at one of the levels"));
    assert!(
        words(&Series { levels: good.levels[..20].to_vec(), stack_level: 10, ..good.clone() }).contains("the saturation is not reached")
    );
    let mut falling = good.clone();
    falling.levels.swap(3, 4);
    assert!(words(&falling).contains("must rise"));
    let broken = photon_transfer(&good, &mut |_, _| Err("the shutter is stuck".into())).unwrap_err();
    assert_eq!(broken, EmvaError::Camera("the shutter is stuck".into()));
}

//! Calibrations from end to end: campaigns in files, readings by the ray engine, curves, what they are worth, what they do not see.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod disk;

use std::process::Command;

use disk::Repository;
use etendue::calibration::evidence::ClassicRule;
use etendue::calibration::{Chooser, Exposures, FitOptions, PriorKind, Readings, fit, suggestion, warm};
use etendue::characterization::campaign::{self, normal};
use etendue::characterization::readings_table::readings_from_csv;
use etendue::estimate::{Stop, Watch};
use etendue::measurement::measure;
use etendue::plan::{Plan, PlanOptions};
use etendue::report::calibration::{covariance_root_to_csv, curve_to_csv, directional_to_csv, readings_to_csv, to_json, to_sensor_file};
use etendue::scene::{Calibration, Files, MemoryFiles, read_calibration, read_scene};
use etendue::sensor::Acceptance;
use etendue::spectrum::{Density, library};
use etendue::study::calibrate::suggest::Wanted;
use etendue::study::calibrate::{CalibrateOptions, Calibrated, UNDETERMINED, calibrate};

fn watched<R>(work: impl FnOnce(&Watch<'_>) -> R) -> R {
    work(&Watch { now: &|| 0.0, progress: &|_| {} })
}

fn campaign_of(file: &str) -> Calibration {
    read_calibration(&format!("scenes/calibration/{file}"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"))
}

fn run(calibration: &Calibration, options: &CalibrateOptions) -> Calibrated {
    watched(|watch| calibrate(calibration, options, watch)).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_lux_meter_head_is_found_on_its_bench() {
    let calibration = campaign_of("monochromator.ron");
    let calibrated = run(&calibration, &CalibrateOptions::default());
    let channel = &calibrated.channels[0];
    // Light at half its height ends 2.5 nm beyond the first and the last setting, 380 nm and 780 nm; the nodes go on to 376 nm and 784 nm.
    assert_eq!(channel.unseen_nm, [(376.0, 377.0), (783.0, 784.0)]);
    let truth = channel.truth.as_ref().unwrap();
    let within =
        (0..truth.len()).filter(|&k| (channel.curve.values[k] - truth[k]).abs() <= 2.58 * channel.standard_uncertainties[k]).count();
    assert!(within as f64 >= 0.95 * truth.len() as f64, "{within} of {}", truth.len());
    assert_eq!(channel.uses.len(), 1 + 4 + 5, "f1′, F* of all lamps but A, s_v of all lamps");
    for q in &channel.uses {
        let (u, truth) = (q.standard_uncertainty, q.truth.unwrap());
        assert!((q.value - truth).abs() < 3.5 * u, "{}: {} ± {u} against {truth}", q.name, q.value);
        // GUM Supplement 1: 1000 draws know a standard deviation within 2.2 %; f1′ bends where the curve is zero.
        let bends = if q.name == "f1′" { 0.35 } else { 0.09 };
        assert!((q.monte_carlo / u - 1.0).abs() < bends, "{}: linear {u}, drawn {}", q.name, q.monte_carlo);
    }
    let f1 = &channel.uses[0];
    assert!(f1.name == "f1′" && (f1.truth.unwrap() - 0.0545).abs() < 2e-4 && f1.standard_uncertainty < 2e-3, "{f1:?}");
}

/// Derivatives that are propagated are derivatives: against differences of the exact quantities.
#[test]
fn derivatives_are_those_of_the_quantities() {
    let calibration = campaign_of("monochromator.ron");
    let calibrated = run(&calibration, &CalibrateOptions::default());
    let channel = &calibrated.channels[0];
    let uses_of = |values: &[f64]| {
        let mut curve = channel.curve.clone();
        curve.values = values.to_vec();
        etendue::study::calibrate::propagate::uses(&calibrated.nodes_nm, &curve, None, &calibration.lamps, 0.0, 0).unwrap()
    };
    for k in [60, 100, 130] {
        let h = 1e-4 * channel.curve.values[k];
        let shifted = |by: f64| {
            let mut values = channel.curve.values.clone();
            values[k] += by;
            uses_of(&values)
        };
        for ((up, down), q) in shifted(h).iter().zip(&shifted(-h)).zip(&channel.uses) {
            let slope = (up.value - down.value) / (2.0 * h);
            let size = q.gradient.iter().fold(0.0f64, |most, g| most.max(g.abs()));
            assert!((slope - q.gradient[k]).abs() < 0.05 * size, "{} at node {k}: {slope:e}, not {:e}", q.name, q.gradient[k]);
        }
    }
}

#[test]
fn the_fitted_sensor_reads_as_the_true_one_within_its_uncertainty() {
    let calibration = campaign_of("monochromator.ron");
    let calibrated = run(&calibration, &CalibrateOptions { seed: 3, ..CalibrateOptions::default() });
    let channel = &calibrated.channels[0];
    let sensor = &calibration.bench.instruments[0].sensor;
    let Acceptance::Directional(response) = &sensor.acceptance else { panic!("a table") };
    let scene = |sensor: &str, lamp: &str| {
        format!(
            "Scene(sources: [(name: \"lamp\", shape: Point, at: (0, 0.4, 2), strength: Candela(100), spectrum: \"{lamp}\")],
             instruments: [(name: \"meter\", sensor: \"{sensor}\", at: (0, 0, 0), facing: (0, 0, 1))])"
        )
    };
    let repository = |path: &str| Repository.read(path, 1 << 24).unwrap();
    let mut files = MemoryFiles::new()
        .with("fitted.csv", curve_to_csv(&calibrated, channel).unwrap())
        .with("directional.csv", directional_to_csv(response))
        .with("fitted.ron", to_sensor_file(&calibrated, sensor, &["fitted.csv".to_owned()], "directional.csv"));
    for (name, path) in [
        ("true.ron", "sensors/class-b-lux-meter.ron"),
        ("class-b/responsivity.csv", "sensors/class-b/responsivity.csv"),
        ("class-b/directional.csv", "sensors/class-b/directional.csv"),
    ] {
        files = files.with(name, repository(path));
    }
    for (lamp, _) in &calibration.lamps {
        let read = |sensor: &str| {
            let files = files.clone().with("scene.ron", scene(sensor, lamp));
            let scene = read_scene("scene.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"));
            let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
            watched(|watch| measure(&scene, &plan, &Stop::default(), 0, watch)).unwrap().readings[0].value
        };
        let (fitted, truth) = (read("fitted.ron"), read("true.ron"));
        let q = channel.uses.iter().find(|q| q.name == format!("s_v for {lamp}")).unwrap();
        let u = q.standard_uncertainty / q.value;
        assert!((fitted / truth - 1.0).abs() < 3.0 * u, "{lamp}: {fitted} and {truth}, u {u}");
        assert!(u < 0.01 && u > 0.004, "{lamp}: {u}");
    }
}

/// One tracing for all exposures reads what tracing each of them reads: on a black bench, beside a coloured wall, before a chart, behind an attenuator.
#[test]
fn readings_are_those_of_the_engine_for_each_exposure() {
    let lamp = "(name: \"lamp\", shape: Point, at: (0.3, 0, 1), strength: Watts(10), spectrum: \"A\")";
    let head = "(name: \"head\", list: [(at: (0, 0, 0), facing: (0, 0, 1)), (at: (0, 0, 0.5), facing: (0, 0, 1))],
        sensor: Sensor(aperture: Point, acceptance: Cosine, channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))";
    let wall = |name: &str| format!("(name: \"wall\", shape: Rectangle(1, 1), surface: \"{name}\", at: (0, 0.5, 0.5), facing: (0, -1, 0))");
    let bench = |surface: &str| {
        format!("Scene(surfaces: {{ \"wall\": {surface} }}, objects: [{}], sources: [{lamp}], instruments: [{head}])", wall("wall"))
    };
    let leds = "Leds(spectra: [Led(peak_nm: 500, fwhm_nm: 20), Led(peak_nm: 560, fwhm_nm: 40), \"LED-B3\"])";
    let far = "Leds(spectra: [Led(peak_nm: 600, fwhm_nm: 20)], pose: 1, attenuator: 0.25)";
    let chart = "Chart(reflectances: [0.9, Gaussian(peak: 0.8, centre_nm: 600, fwhm_nm: 80)], lamps: [\"D65\"])";
    let coloured = "Lambertian(Gaussian(peak: 0.8, centre_nm: 600, fwhm_nm: 150))";
    for (surface, exposures, test) in [
        ("Black", format!("{leds}, {far}"), ""),
        ("Lambertian(0.8)", leds.to_owned(), ""),
        (coloured, format!("{leds}, {far}"), ""),
        ("Lambertian(0.5)", chart.to_owned(), "test_surface: \"wall\","),
    ] {
        let campaign = format!(
            "Calibration(bench: \"bench.ron\", {test} exposures: [{exposures}], noise: (relative: 0), curve: (from_nm: 380, to_nm: 780, step_nm: 10))"
        );
        let files = MemoryFiles::new().with("bench.ron", bench(surface)).with("c.ron", campaign);
        let calibration = read_calibration("c.ron", &files, None).unwrap_or_else(|problems| panic!("{problems}"));
        let stop = Stop { target: None, samples: Some(1 << 16), ..Stop::default() };
        let light = watched(|watch| campaign::light(&calibration, &stop, 1, watch)).unwrap();
        let readings = campaign::simulated(&calibration, &light.spectra, 0);
        for (i, exposure) in calibration.exposures.iter().enumerate() {
            let mut scene = calibration.bench.clone();
            scene.sources[0].density = exposure.emitted.clone();
            if let (Some(at), Some(patch)) = (calibration.test_surface, &exposure.patch) {
                scene.surfaces[at].reflectance = patch.clone();
            }
            let plan = Plan::new(&scene, &PlanOptions::default()).unwrap();
            let measured = watched(|watch| measure(&scene, &plan, &stop, 2, watch)).unwrap();
            let (one, each) = (readings[0].values[i], &measured.readings[exposure.pose]);
            // Light is linear between 48 wavelengths of a coloured bench; elsewhere nothing but the rays differs.
            let bent = if surface == coloured { 1e-3 * each.value } else { 1e-9 * each.value };
            let u = (light.relative_uncertainty * one).hypot(each.standard_uncertainty());
            assert!((one - each.value).abs() < 4.0 * u + bent, "{surface}, {}: {one}, not {} ± {u}", exposure.label, each.value);
            assert!(each.value > 0.0 && u < 0.02 * each.value, "{surface}, {}: {} ± {u}", exposure.label, each.value);
        }
    }
}

#[test]
fn a_camera_is_found_before_a_chart() {
    let calibration = campaign_of("camera.ron");
    assert_eq!(calibration.exposures.len(), 48);
    let calibrated = run(&calibration, &CalibrateOptions { stop: Stop { target: Some(1e-3), ..Stop::default() }, ..Default::default() });
    assert!(calibrated.prior.0.contains("camera components"), "{:?}", calibrated.prior);
    let (mut inside, mut count, mut square, mut peak) = (0, 0, 0.0, 0.0f64);
    for channel in &calibrated.channels {
        for ((s, t), u) in channel.curve.values.iter().zip(channel.truth.as_ref().unwrap()).zip(&channel.standard_uncertainties) {
            inside += usize::from((s - t).abs() <= 2.58 * u);
            count += 1;
            square += (s - t).powi(2);
            peak = peak.max(*t);
        }
    }
    let rmse = (square / count as f64).sqrt() / peak;
    println!("camera: {rmse:.4} of the peak, {inside} of {count} within 99 % bands");
    assert!(rmse < 0.05 && inside as f64 >= 0.95 * count as f64, "{rmse}, {inside} of {count}");
    // Readings are the integrals of curve and light, but for noise.
    let white = calibrated.labels.iter().position(|l| l.starts_with("white") && l.ends_with("D65")).unwrap();
    let (reading, curve) = (calibrated.channels[1].readings.values[white], calibrated.channels[1].truth.as_ref().unwrap());
    let expected: f64 = calibrated.exposures.row(white).iter().zip(curve).map(|(a, s)| a * s).sum();
    assert!((reading / expected - 1.0).abs() < 0.02, "{reading} and {expected}");
}

#[test]
fn three_leds_leave_most_of_the_curve_open_and_say_so() {
    let calibration = campaign_of("three-leds.ron");
    let calibrated = run(&calibration, &CalibrateOptions { suggest: 3, ..CalibrateOptions::default() });
    let channel = &calibrated.channels[0];
    let unseen = |nm: f64| channel.unseen_nm.iter().any(|&(from, to)| (from..=to).contains(&nm));
    assert!(unseen(390.0) && unseen(740.0), "{:?}", channel.unseen_nm);
    assert!(!unseen(450.0) && !unseen(530.0) && !unseen(630.0), "{:?}", channel.unseen_nm);
    let peak = channel.curve.values.iter().fold(0.0f64, |most, s| most.max(*s));
    let at = |nm: f64| calibrated.nodes_nm.iter().position(|node| *node == nm).unwrap();
    assert!(channel.standard_uncertainties[at(740.0)] > 0.5 * peak);
    let truth = channel.truth.as_ref().unwrap();
    assert!((0..truth.len()).all(|k| (channel.curve.values[k] - truth[k]).abs() <= 2.58 * channel.standard_uncertainties[k]));
    assert_eq!(calibrated.suggestions.len(), 3);
    let text = etendue::report::calibration::to_text(&calibrated);
    assert!(text.contains("do not determine the curve at 380 nm to") && text.contains("Further exposures"), "{text}");
    // The same for what the meter is for: light of D65.
    let wanted = Wanted::Quantity("s_v for D65".to_owned());
    let for_d65 = run(&calibration, &CalibrateOptions { suggest: 2, wanted, ..CalibrateOptions::default() });
    let use_of_d65 = channel.uses.iter().find(|q| q.name == "s_v for D65").unwrap();
    let (g, c) = (&use_of_d65.gradient, &channel.curve.expected);
    let square: f64 = (0..g.len()).map(|k| g[k] * (0..g.len()).map(|l| c[(k, l)] * g[l]).sum::<f64>()).sum();
    let first = &for_d65.suggestions[0];
    assert!((first.before / square.sqrt() - 1.0).abs() < 1e-9 && first.after < first.before, "{first:?}, {square}");
}

/// LEDs of 25 nm at these wavelengths on nodes of 10 nm.
fn leds(nodes: &[f64], peaks_nm: &[f64]) -> Exposures {
    let spectra: Vec<(String, Density)> = peaks_nm.iter().map(|nm| (format!("{nm} nm"), Density::led(*nm, 25.0).unwrap())).collect();
    Exposures::new(nodes, &spectra).unwrap()
}

fn readings(exposures: &Exposures, truth: &[f64], relative: f64, seed: u64) -> Readings {
    let exact = exposures.expected(truth);
    let u: Vec<f64> = exact.iter().map(|y| relative * y.abs() + 1e-5).collect();
    let values = exact.iter().zip(&u).enumerate().map(|(i, (y, u))| y + u * normal(seed, &[i as u64])).collect();
    Readings { channel: "E_v".to_owned(), values, standard_uncertainties: u }
}

fn photopic(nodes: &[f64]) -> Vec<f64> {
    nodes.iter().map(|nm| library::v_lambda().at(*nm)).collect()
}

#[test]
fn further_exposures_narrow_the_bands_each_time() {
    let nodes: Vec<f64> = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    let truth = photopic(&nodes);
    let exposures = leds(&nodes, &[450.0, 530.0, 630.0]);
    let fitted = fit(&exposures, &[readings(&exposures, &truth, 0.005, 1)], &FitOptions::default()).unwrap();
    let further = leds(&nodes, &(39..=77).step_by(2).map(|k| 10.0 * f64::from(k)).collect::<Vec<_>>());
    let steps = suggestion::greedy(&fitted.curves, &[], &further, 0.005, further.len());
    assert_eq!(steps.len(), further.len());
    assert!(steps.iter().all(|s| s.after <= s.before), "{steps:?}");
    assert!(steps.windows(2).all(|w| w[1].before == w[0].after && w[0].before - w[0].after >= 0.0));
    // What is told is what the choice goes by: no other candidate leaves less.
    for i in 0..further.len() {
        let alone = suggestion::greedy(&fitted.curves, &[], &further.subset(&[i]), 0.005, 1);
        assert!(alone[0].after >= steps[0].after * (1.0 - 1e-12) && alone[0].before == steps[0].before, "{i}");
    }
    // And when it is fitted anew, with all that the readings then say about the prior.
    let mut last = f64::INFINITY;
    for count in [3, 6, 12, 20] {
        let mut peaks = vec![450.0, 530.0, 630.0];
        peaks.extend(steps.iter().take(count - 3).map(|s| 390.0 + 20.0 * s.index as f64));
        let exposures = leds(&nodes, &peaks);
        let fitted = fit(&exposures, &[readings(&exposures, &truth, 0.005, 1)], &FitOptions::default()).unwrap();
        let u = fitted.curves[0].standard_uncertainties();
        let rms = (u.iter().map(|u| u * u).sum::<f64>() / u.len() as f64).sqrt();
        println!("{count} LEDs: u {rms:.3} of the peak");
        assert!(rms < last, "{count}: {rms} after {last}");
        last = rms;
    }
}

#[test]
fn suggested_exposures_beat_a_choice_by_chance() {
    let nodes: Vec<f64> = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    let truth = photopic(&nodes);
    let start = [450.0, 530.0, 630.0];
    let candidates: Vec<f64> = (39..=77).map(|k| 10.0 * f64::from(k)).collect();
    let further = leds(&nodes, &candidates);
    let error = |more: &[f64], seed: u64| {
        let peaks: Vec<f64> = start.iter().chain(more).copied().collect();
        let exposures = leds(&nodes, &peaks);
        let fitted = fit(&exposures, &[readings(&exposures, &truth, 0.005, seed)], &FitOptions::default()).unwrap();
        let square = fitted.curves[0].values.iter().zip(&truth).map(|(s, t)| (s - t).powi(2)).sum::<f64>();
        (square / truth.len() as f64).sqrt()
    };
    let (mut wins, mut suggested_sum, mut chance_sum, mut ratios) = (0, 0.0, 0.0, Vec::new());
    for trial in 0..50u64 {
        let exposures = leds(&nodes, &start);
        let fitted = fit(&exposures, &[readings(&exposures, &truth, 0.005, trial)], &FitOptions::default()).unwrap();
        let steps = suggestion::greedy(&fitted.curves, &[], &further, 0.005, 4);
        let suggested: Vec<f64> = steps.iter().map(|s| candidates[s.index]).collect();
        // Four of the candidates by chance, each once.
        let mut order: Vec<(f64, f64)> = candidates.iter().enumerate().map(|(i, nm)| (normal(1000 + trial, &[7, i as u64]), *nm)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let chance: Vec<f64> = order.iter().take(4).map(|o| o.1).collect();
        let (by_suggestion, by_chance) = (error(&suggested, trial), error(&chance, trial));
        wins += usize::from(by_suggestion < by_chance);
        ratios.push((by_suggestion / by_chance).ln());
        suggested_sum += by_suggestion;
        chance_sum += by_chance;
    }
    let mean = ratios.iter().sum::<f64>() / 50.0;
    let u = (ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / 49.0 / 50.0).sqrt();
    println!("suggested {:.4}, by chance {:.4}, better in {wins} of 50", suggested_sum / 50.0, chance_sum / 50.0);
    println!("ln(suggested / by chance): mean {mean:.3} ± {u:.3}");
    // Four standard uncertainties; and of 50 throws of a coin, 33 or more come up heads with a probability of 1.6 %.
    assert!(mean < -4.0 * u && wins >= 33 && suggested_sum < chance_sum, "better in {wins} of 50, ln of the ratio {mean} ± {u}");
}

/// Refits are fits: of the same readings the same curve, of others what a fit from the start finds, and over many draws the noise that is propagated.
#[test]
fn refits_are_fits_and_scatter_by_the_propagated_noise() {
    let nodes: Vec<f64> = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    let truth: Vec<f64> = photopic(&nodes).iter().map(|v| v + 0.3).collect();
    let exposures = leds(&nodes, &(38..=78).map(|k| 10.0 * f64::from(k)).collect::<Vec<_>>());
    let first = readings(&exposures, &truth, 0.01, 1);
    let fitted = fit(&exposures, std::slice::from_ref(&first), &FitOptions::default()).unwrap();
    let refitter = warm(&exposures, std::slice::from_ref(&first), &PriorKind::Smooth).unwrap();
    let again = refitter.refit(std::slice::from_ref(&first.values)).unwrap().remove(0);
    let curve = &fitted.curves[0];
    assert!(again.iter().zip(&curve.values).all(|(a, b)| (a - b).abs() < 1e-9), "the same readings, another curve");
    let draws: Vec<Vec<f64>> = (0..1000u64)
        .map(|draw| {
            let both = first.values.iter().zip(&first.standard_uncertainties).enumerate();
            let values = both.map(|(i, (y, u))| y + u * normal(draw + 7, &[i as u64])).collect();
            refitter.refit(&[values]).unwrap().remove(0)
        })
        .collect();
    for k in (4..37).step_by(4) {
        let mean = draws.iter().map(|s| s[k]).sum::<f64>() / 1000.0;
        let spread = (draws.iter().map(|s| (s[k] - mean).powi(2)).sum::<f64>() / 999.0).sqrt();
        let noise = curve.noise[(k, k)].sqrt();
        // The choice of the smoothness follows the noise, too, which the linear propagation leaves out.
        assert!((0.9..1.4).contains(&(spread / noise)), "node {k}: drawn {spread}, propagated {noise}");
    }
    assert!(refitter.refit(&[vec![1.0; 3]]).is_err() && refitter.refit(&[vec![f64::NAN; 41]]).is_err());
}

/// χ² per degree of freedom, mean over 500 sets of readings, and the share of nodes within their 95 % bands.
fn over_500_seeds(truth: &[f64], nodes: &[f64]) -> (f64, f64) {
    let scan: Vec<(String, Density)> =
        (76..=156).map(|k| (format!("{} nm", 5 * k), Density::gaussian(1.0, 5.0 * f64::from(k), 6.0).unwrap())).collect();
    let exposures = Exposures::new(nodes, &scan).unwrap();
    let (mut chi, mut inside, mut count) = (0.0, 0.0, 0.0);
    for seed in 0..500u64 {
        let exact = exposures.expected(truth);
        let values = exact.iter().enumerate().map(|(i, y)| y + 0.01 * normal(seed, &[i as u64])).collect();
        let readings = Readings { channel: "E_v".to_owned(), values, standard_uncertainties: vec![0.01; exact.len()] };
        let curve = fit(&exposures, &[readings], &FitOptions::default()).unwrap().curves.remove(0);
        chi += curve.chi_squared / (exact.len() as f64 - curve.effective_parameters) / 500.0;
        let u = curve.standard_uncertainties();
        for k in (0..nodes.len()).filter(|k| curve.undetermined[*k] < UNDETERMINED) {
            inside += f64::from((curve.values[k] - truth[k]).abs() <= 1.96 * u[k]);
            count += 1.0;
        }
    }
    assert!(count > 0.9 * 500.0 * nodes.len() as f64, "{count} nodes determined");
    println!("χ² per degree of freedom {chi:.3}, {:.2} % of {count} nodes within 95 % bands", 100.0 * inside / count);
    (chi, inside / count)
}

#[test]
fn over_500_seeds_chi_squared_is_one_and_the_bands_hold() {
    let nodes: Vec<f64> = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    // Four standard deviations of a mean over 500 values of χ²/68.
    let limit = 4.0 * (2.0f64 / 68.0 / 500.0).sqrt();
    let raised: Vec<f64> = photopic(&nodes).iter().map(|v| v + 0.3).collect();
    let (chi, inside) = over_500_seeds(&raised, &nodes);
    assert!((chi - 1.0).abs() < limit && inside >= 0.95, "{chi}, {inside}");
    // A curve that is held by zero over a third of its nodes fits fewer numbers than `effective_parameters` counts without that.
    let (chi, inside) = over_500_seeds(&photopic(&nodes), &nodes);
    assert!(chi > 1.0 - limit && chi < 1.0 + 2.0 * limit && inside >= 0.95, "{chi}, {inside}");
}

#[test]
fn extreme_readings_end_in_honest_bands_or_in_words() {
    let nodes: Vec<f64> = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    let truth = photopic(&nodes);
    let scan = |peaks: &[f64]| {
        let spectra: Vec<(String, Density)> =
            peaks.iter().map(|nm| (format!("{nm} nm"), Density::gaussian(1.0, *nm, 8.0).unwrap())).collect();
        Exposures::new(&nodes, &spectra).unwrap()
    };
    let peaks: Vec<f64> = (39..=77).map(|k| 10.0 * f64::from(k)).collect();
    let doubled: Vec<f64> = peaks.iter().flat_map(|nm| [*nm, *nm]).collect();
    let held = |exposures: &Exposures, readings: &Readings| {
        let curve = fit(exposures, std::slice::from_ref(readings), &FitOptions::default()).unwrap().curves.remove(0);
        let u = curve.standard_uncertainties();
        assert!(curve.values.iter().chain(&u).all(|x| x.is_finite() && *x >= 0.0));
        // Where no exposure shines nothing is promised but to say so.
        let seen: Vec<usize> = (0..nodes.len()).filter(|k| curve.undetermined[*k] < UNDETERMINED).collect();
        let lit = |k: usize| (0..exposures.len()).any(|i| exposures.row(i)[k] > 1e-3 * exposures.row(i).iter().sum::<f64>());
        assert!(seen.len() < nodes.len() || (0..nodes.len()).filter(|k| lit(*k)).count() > nodes.len() / 2, "all of it determined?");
        let inside = seen.iter().filter(|k| (curve.values[**k] - truth[**k]).abs() <= 3.0 * u[**k] + 1e-9).count();
        inside as f64 / seen.len().max(1) as f64
    };
    for relative in [0.0, 1e-6, 1e-3, 0.1] {
        for exposures in [scan(&peaks), scan(&doubled), scan(&peaks[..3]), scan(&[555.0])] {
            let share = held(&exposures, &readings(&exposures, &truth, relative, 5));
            assert!(share >= 0.95, "noise {relative}, {} exposures: {share}", exposures.len());
        }
    }
    let exposures = scan(&peaks);
    let mut dead = readings(&exposures, &truth, 0.01, 1);
    dead.values.fill(0.0);
    let said = fit(&exposures, &[dead], &FitOptions::default()).unwrap_err().to_string();
    assert!(said.contains("every reading is zero"), "{said}");
    // Readings of the same light that contradict each other show in χ², which a report tells.
    let exposures = scan(&doubled);
    let mut torn = readings(&exposures, &truth, 0.001, 1);
    torn.values.iter_mut().skip(1).step_by(2).for_each(|y| *y *= 1.1);
    let curve = fit(&exposures, &[torn], &FitOptions::default()).unwrap().curves.remove(0);
    assert!(curve.chi_squared > 100.0 * exposures.len() as f64 / 2.0, "{}", curve.chi_squared);
}

#[test]
fn nodes_that_are_too_coarse_are_told() {
    let mut calibration = campaign_of("monochromator.ron");
    let told = |calibration: &Calibration| {
        let calibrated = run(calibration, &CalibrateOptions::default());
        calibrated.remarks.iter().any(|remark| remark.contains("give `curve` a smaller `step_nm`"))
    };
    assert!(!told(&calibration));
    calibration.nodes_nm = (38..=78).map(|k| 10.0 * f64::from(k)).collect();
    calibration.noise.relative = 1e-5;
    calibration.noise.absolute = 1e-5;
    calibration.scale_uncertainty = 0.0;
    assert!(told(&calibration));
}

#[test]
fn every_rule_finds_the_curve() {
    let calibration = campaign_of("monochromator.ron");
    for rule in [ClassicRule::Discrepancy, ClassicRule::CrossValidation, ClassicRule::LCurve] {
        let options =
            CalibrateOptions { fit: FitOptions { chooser: Chooser::Classic(rule), ..FitOptions::default() }, ..Default::default() };
        let calibrated = run(&calibration, &options);
        let channel = &calibrated.channels[0];
        let truth = channel.truth.as_ref().unwrap();
        let peak = truth.iter().fold(0.0f64, |most, s| most.max(*s));
        let worst = channel.curve.values.iter().zip(truth).fold(0.0f64, |most, (s, t)| most.max((s - t).abs()));
        assert!(worst < 0.05 * peak, "{rule:?}: {worst} of {peak}");
    }
}

#[test]
fn readings_that_are_written_are_read_again_and_give_the_same_curve() {
    let calibration = campaign_of("monochromator.ron");
    let calibrated = run(&calibration, &CalibrateOptions::default());
    let written = readings_to_csv(&calibrated);
    let data = readings_from_csv("r.csv", &written, &calibration).unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!(data[0].values, calibrated.channels[0].readings.values);
    let again = run(&calibration, &CalibrateOptions { data: Some(data), ..CalibrateOptions::default() });
    assert!(!again.simulated && again.channels[0].truth.is_none());
    assert_eq!(again.channels[0].curve.values, calibrated.channels[0].curve.values);
    let json: serde_json::Value = serde_json::from_str(&to_json(&again)).unwrap();
    assert_eq!(json["channels"][0]["responsivity"].as_array().unwrap().len(), calibration.nodes_nm.len());
    assert!(json["channels"][0]["truth"].is_null());
    // F Fᵀ is the covariance.
    let text = covariance_root_to_csv(&again, &again.channels[0]);
    let rows: Vec<Vec<f64>> = text.lines().skip(3).map(|l| l.split(',').skip(1).map(|x| x.parse().unwrap()).collect()).collect();
    let curve = &again.channels[0].curve;
    for k in [0, 40, 100, rows.len() - 1] {
        let variance: f64 = rows[k].iter().map(|f| f * f).sum();
        let expected = curve.noise[(k, k)] + curve.structure[(k, k)];
        assert!((variance / expected - 1.0).abs() < 1e-3, "node {k}: {variance} and {expected}");
    }
}

#[test]
fn what_is_wrong_with_a_table_of_readings_is_said_with_its_place() {
    let calibration = campaign_of("three-leds.ron");
    let told = |text: &str| match readings_from_csv("lab.csv", text, &calibration) {
        Ok(_) => panic!("read without a problem:\n{text}"),
        Err(problems) => problems
            .0
            .iter()
            .map(|p| format!("{}:{} {} | {}", p.line, p.column, p.message, p.help.clone().unwrap_or_default()))
            .collect::<Vec<_>>(),
    };
    let head = "exposure,E_v (lx),u(E_v) (lx)\n";
    let whole = format!("{head}blue,1,0.1\ngreen,2,0.1\nred,1,0.1\n");
    assert!(readings_from_csv("lab.csv", &whole, &calibration).is_ok());
    assert!(readings_from_csv("lab.csv", &whole.replace(',', ";"), &calibration).is_ok());
    for (text, words) in [
        ("", vec!["1:1 the file of readings is empty"]),
        ("exposure,E_v (lx)\nblue,1\ngreen,2\nred,1\n", vec!["1:1 there is no column `u(E_v) (lx)`"]),
        (
            "exposure,Ev (lx),u(E_v) (lx)\nblue,1,0.1\ngreen,2,0.1\nred,1,0.1\n",
            vec!["1:10 the column `Ev (lx)` is not one of this calibration | did you mean `E_v (lx)`"],
        ),
        ("exposure,E_v,u(E_v) (lx)\nblue,1,0.1\ngreen,2,0.1\nred,1,0.1\n", vec!["1:10 the column `E_v` states no unit | write `E_v (lx)`"]),
        (
            "exposure,E_v (klx),u(E_v) (lx)\nblue,1,0.1\ngreen,2,0.1\nred,1,0.1\n",
            vec!["1:10 the unit of `E_v` is klx, and the channel reads lx"],
        ),
        (&format!("{head}blue,1,0.1\nred,1,0.1\n"), vec!["1:1 exposures without readings: \"green\""]),
        (
            &format!("{head}blue,1,0.1\ngreen,2,0\nred,NaN,-1\n"),
            vec!["3:9 the standard uncertainty of E_v is 0", "4:5 the reading of E_v is NaN", "4:9 the standard uncertainty of E_v is -1"],
        ),
        (
            &format!("{head}blue,1e300,0.1\ngreen,2,1e300\nred,1,\n"),
            vec![
                "2:6 the reading of E_v is 1e300, which is absurd | allowed: up to 1e90",
                "3:9 the standard uncertainty of E_v is 1e300, which is absurd",
                "4:7 the standard uncertainty of E_v is missing",
            ],
        ),
        (
            "exposure;E_v (lx);u(E_v) (lx)\nblue;0,5;0.1\ngreen;2;0.1\nred;1;0.1\n",
            vec!["2:6 the reading of E_v has a decimal comma: `0,5` | write a decimal point: 0.5"],
        ),
        (
            &format!("{head}blue;1;0.1\ngreen,2,0.1\nred,0,0\n"),
            vec![
                "1:1 exposures without readings: \"blue\"",
                "2:1 1 cells where the head has 3 | the head separates its columns by another character than this row's `;`",
                "4:7 the standard uncertainty of E_v is 0 | give the standard uncertainty (k = 1) of the reading, above 0; without one nothing can be said about the curve. \
                 A reading of zero has one, too",
            ],
        ),
        (
            &format!("{head}blue,1,0.1\ngren,2,0.1\nred,1\nred,x,0.1\n"),
            vec![
                "1:1 exposures without readings: \"green\"",
                "3:1 there is no exposure called \"gren\" | did you mean `green`",
                "4:1 2 cells where the head has 3",
                "5:5 the reading of E_v is no number: `x`",
            ],
        ),
    ] {
        let found = told(text);
        assert_eq!(found.len(), words.len(), "{text}\n{found:#?}");
        for (found, words) in found.iter().zip(&words) {
            assert!(found.starts_with(words), "{text}\nfound:    {found}\nexpected: {words}");
        }
    }
}

#[test]
fn what_is_wrong_with_a_calibration_file_is_said_with_its_place() {
    let bench = "Scene(sources: [(name: \"lamp\", shape: Point, at: (0, 0, 1), strength: Watts(1), spectrum: \"A\")],
        instruments: [(name: \"head\", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(aperture: Point, acceptance: Cosine,
            channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))])";
    let good = "Calibration(bench: \"bench.ron\",\nexposures: [Leds(spectra: [\"LED-B1\"])],\nnoise: (relative: 0.01),\ncurve: (from_nm: 400, to_nm: 700, step_nm: 10))";
    let read = |text: &str| read_calibration("c.ron", &MemoryFiles::new().with("bench.ron", bench).with("c.ron", text), None);
    assert!(read(good).is_ok(), "{}", read(good).unwrap_err());
    for (from, to, line, words) in [
        ("Calibration(", "Scene(", 1, "a calibration file holds `Calibration(…)`"),
        ("bench.ron", "bnech.ron", 1, "did you mean `bench.ron`"),
        ("noise: (relative: 0.01),", "", 1, "has no `noise`"),
        ("relative: 0.01", "relativ: 0.01", 3, "did you mean `relative`"),
        ("relative: 0.01", "relative: -0.01", 3, "allowed: 0 to 1, a share of the reading"),
        ("relative: 0.01", "dark: 0.01", 3, "the noise is not stated"),
        ("step_nm: 10", "step_nm: 0.001", 4, "allowed: 2 to 801 nodes"),
        ("from_nm: 400", "from_nm: 800", 4, "the curve has"),
        ("spectra: [\"LED-B1\"]", "spectra: []", 2, "the list of spectra is empty"),
        ("spectra: [\"LED-B1\"]", "spectra: [Led(peak_nm: 450, fwhm_nm: -1)]", 2, "allowed: above 0 nm"),
        ("spectra: [\"LED-B1\"]", "spectra: [Line(900)]", 2, "has no light within the curve, 400 nm to 700 nm"),
        ("Leds(spectra: [\"LED-B1\"])", "Led(\"LED-B1\")", 2, "did you mean `Leds`"),
        ("Leds(spectra: [\"LED-B1\"])", "Leds(spectra: [\"LED-B1\"], pose: 1)", 2, "whole numbers, 0 to 0"),
        ("Leds(spectra: [\"LED-B1\"])", "Chart(reflectances: \"ColorChecker\", lamps: [\"A\"])", 2, "a chart needs a surface in the bench"),
        ("Leds(spectra: [\"LED-B1\"])", "Filters(lamp: \"A\", filters: [1.5])", 2, "allowed: 0 to 1 at every wavelength"),
        (
            "Leds(spectra: [\"LED-B1\"])",
            "Monochromator(from_nm: 400, to_nm: 700, step_nm: 10, fwhm_nm: 5, shape: Trapezoid)",
            2,
            "Triangle",
        ),
        ("Leds(spectra: [\"LED-B1\"])", "", 2, "`exposures` holds 0 exposures"),
    ] {
        assert!(good.contains(from), "{from}");
        let problems = read(&good.replace(from, to)).err().unwrap_or_else(|| panic!("{to}: read without a problem"));
        let said = problems.to_string();
        assert!(said.contains(words), "{to}:\n{said}");
        assert_eq!((problems.0.len(), problems.0[0].line), (1, line), "{to}:\n{said}");
    }
}

#[test]
fn the_command_writes_its_files_and_leaves_nothing_half_written() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("calibrate");
    let _ = std::fs::remove_dir_all(&folder);
    let command = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_etendue")).arg("calibrate").args(arguments).current_dir(disk::root()).output().unwrap()
    };
    let out = folder.to_str().unwrap();
    let done = command(&["scenes/calibration/three-leds.ron", "--suggest", "2", "--out", out]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    for name in
        ["three-leds.txt", "three-leds-E_v.csv", "three-leds-E_v-covariance-root.csv", "three-leds-readings.csv", "three-leds-sensor.ron"]
    {
        assert!(folder.join(name).is_file(), "{name}");
    }
    let used = Command::new(env!("CARGO_BIN_EXE_etendue"))
        .args(["calibrate", "scenes/calibration/three-leds.ron", "--format", "json", "--data"])
        .arg(folder.join("three-leds-readings.csv"))
        .current_dir(disk::root())
        .output()
        .unwrap();
    let json: serde_json::Value = serde_json::from_slice(&used.stdout).unwrap();
    assert_eq!(json["simulated"], false);
    let elsewhere = folder.join("elsewhere");
    for arguments in [
        vec!["scenes/calibration/three-leds.ron", "--data", "Cargo.toml", "--out", elsewhere.to_str().unwrap()],
        vec!["scenes/calibration/monochromator.ron", "--suggest", "2"],
        vec!["scenes/calibration/three-leds.ron", "--suggest", "2", "--reduce", "nonsense"],
        vec!["scenes/office.ron"],
    ] {
        let failed = command(&arguments);
        assert_eq!(failed.status.code(), Some(2), "{arguments:?}: {}", String::from_utf8_lossy(&failed.stderr));
        assert!(String::from_utf8_lossy(&failed.stderr).contains("error:"));
    }
    assert!(!elsewhere.exists());
}

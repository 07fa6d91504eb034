//! Observers as sensors: what their channels indicate.

use crate::observer::{AlphaOpic, Cones, Efficiency, Individual, Matching, efficiency};
use crate::quantity::measurand::Measurand;
use crate::scene::scene_from_text;
use crate::sensor::Channel;
use crate::spectrum::{Density, library};

fn channels(acceptance: &str, channels: &str) -> Vec<Channel> {
    let sensor = format!("Sensor(aperture: Point, acceptance: {acceptance}, channels: {channels})");
    let text = format!("Scene(instruments: [(name: \"m\", sensor: {sensor}, at: (0, 0, 0), facing: (0, 0, 1))])");
    let scene = scene_from_text(&text).unwrap_or_else(|problems| panic!("{problems}"));
    scene.instruments[0].sensor.channels.clone()
}

/// Indication for a spectral irradiance.
fn reads(channel: &Channel, density: &Density) -> f64 {
    channel.scale * density.integral(&[&channel.responsivity])
}

fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "found {found:e}, expected {expected:e}");
}

#[test]
fn tristimulus_channels_are_in_the_unit_of_y() {
    let lamp = library::density("LED-B3").unwrap();
    for set in Matching::ALL.into_iter().filter(|set| !set.has_real_primaries()) {
        let found = channels("Cosine", &format!("Observer(\"{}\")", set.short_title()));
        assert_eq!(found.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(), set.values());
        assert!(found.iter().all(|c| c.reads.unit() == "lx"));
        let lx = efficiency::luminous(&lamp, set.efficiency().unwrap());
        // The second function and the luminous efficiency are separate tables, which agree to a unit of the last digit.
        assert!((reads(&found[1], &lamp) / lx - 1.0).abs() < 2e-6);
    }
}

#[test]
fn radiances_are_irradiances_over_the_projected_solid_angle() {
    let lamp = Density::illuminant_a();
    let accepted = std::f64::consts::PI * 2f64.to_radians().sin().powi(2);
    for observer in ["CIE 1931", "cones 2 degree", "CIE S 026", "photopic and scotopic"] {
        let irradiances = channels("Cone(half_angle_deg: 2)", &format!("[Observer(\"{observer}\")]"));
        let radiances = channels("Cone(half_angle_deg: 2)", &format!("Observer(name: \"{observer}\", of: Radiance)"));
        let acceptance = crate::sensor::Acceptance::Cone { half_angle_rad: 2f64.to_radians() };
        for (e, l) in irradiances.iter().zip(&radiances) {
            let per = |c: &Channel| c.indication_per_irradiance(&crate::sensor::Aperture::Point, &acceptance).unwrap();
            assert_close(per(l) * accepted, per(e));
            assert_eq!(reads(e, &lamp) > 0.0, reads(l, &lamp) > 0.0);
            assert!(l.reads.unit() == "cd/m²" || l.reads.unit() == "W/(m² sr)", "{}", l.reads.unit());
        }
    }
}

#[test]
fn cones_of_a_sensor_are_those_of_the_observer() {
    let lamp = library::density("D65").unwrap();
    let individual = Cones::Individual(Individual { age_yr: 60.0, field_deg: 4.0 });
    let found = channels("Cosine", "Observer(name: \"cie 170-1\", field_deg: 4, age_yr: 60)");
    for (channel, expected) in found.iter().zip(individual.excitations(&lamp).unwrap()) {
        assert_close(reads(channel, &lamp), expected);
        assert_eq!(channel.reads.unit(), "W/m²");
    }
}

#[test]
fn equivalent_daylight_illuminance_of_daylight_is_its_illuminance() {
    let d65 = library::density("D65").unwrap();
    let lx = efficiency::luminous(&d65, Efficiency::Photopic1924);
    for alpha in AlphaOpic::ALL {
        let own = channels("Cosine", &format!("[(name: \"a\", reads: EquivalentDaylightIlluminance(\"{}\"))]", alpha.name()));
        assert_close(reads(&own[0], &d65), lx);
        // A meter that knows nothing of photoreceptors, adjusted with daylight, is true for daylight.
        let form = format!("EquivalentDaylightIlluminance(receptor: \"{}\", adjusted_with: \"D65\")", alpha.index());
        let adjusted = channels("Cosine", &format!("[(name: \"a\", responsivity: 1, reads: {form})]"));
        assert_close(reads(&adjusted[0], &d65), lx);
        assert_eq!(adjusted[0].reads.unit(), "lx");
    }
}

#[test]
fn scotopic_and_weighted_channels_indicate_what_they_say() {
    let lamp = Density::illuminant_a();
    let truth = efficiency::luminous(&lamp, Efficiency::Scotopic1951);
    let found = channels(
        "Cosine",
        r#"[(name: "a", reads: ScotopicIlluminance), (name: "b", responsivity: "V", reads: ScotopicIlluminance(adjusted_with: "A")),
            (name: "c", responsivity: 1, reads: Weighted(name: "n", symbol: "s", unit: "u", per_watt: 3)),
            (name: "d", responsivity: 1, reads: Weighted(name: "n", symbol: "s", unit: "u", per_watt: 3, of: Radiance))]"#,
    );
    assert_close(reads(&found[0], &lamp), truth);
    assert_close(reads(&found[1], &lamp), truth);
    assert_close(reads(&found[2], &lamp), 3.0 * lamp.total());
    assert_close(reads(&found[3], &lamp) * std::f64::consts::PI, 3.0 * lamp.total());
    assert_eq!(found[2].reads, Measurand::Weighted { name: "n".into(), symbol: "s".into(), unit: "u".into() });
}

#[test]
fn any_luminous_efficiency_is_an_observer_with_its_own_efficacy() {
    let lamp = library::density("LED-B3").unwrap();
    let of = [
        ("V_M", Efficiency::JuddVos1978),
        ("V_F", Efficiency::Physiological2),
        ("V_F,10", Efficiency::Physiological10),
        ("V_10", Efficiency::TenDegree1964),
    ];
    for (name, efficiency) in of {
        let found = channels("Cosine", &format!("Observer(\"{name}\")"));
        assert_eq!((found.len(), found[0].reads.unit()), (1, "lx"));
        assert_close(reads(&found[0], &lamp), efficiency::luminous(&lamp, efficiency));
    }
    // MES2 at its two ends: rods alone and cones alone.
    let mesopic = |m: f64| reads(&channels("Cosine", &format!("Observer(name: \"mesopic\", adaptation: {m})"))[0], &lamp);
    assert_close(mesopic(1.0), efficiency::luminous(&lamp, Efficiency::Photopic1924));
    let scotopic = efficiency::luminous(&lamp, Efficiency::Scotopic1951);
    // 683.002 · 1699/683 instead of 1700.05.
    assert_close(mesopic(0.0), scotopic * (683.002 * 1699.0 / 683.0) / 1700.05);
}

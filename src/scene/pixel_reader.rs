//! `Pixel(…)` → a camera pixel.
//!
//! ```ron
//! Pixel(
//!     gain_dn_per_e: 0.25, full_well_e: 14000, bits: 12, black_dn: 64,
//!     read_noise_e: 8, dark_current_e_s: 30, reference_temperature_c: 30, doubling_k: 8,
//!     dsnu_e: 3, prnu: 0.008,
//! )
//! ```
//!
//! | key | unit | allowed | if left out |
//! |---|---|---|---|
//! | `gain_dn_per_e` | DN/e⁻ | 1e-9 to 1e9 | – |
//! | `full_well_e` | e⁻ | 1 to 1e12 | – |
//! | `bits` | 1 | 1 to 16, whole | – |
//! | `black_dn` | DN | 0 to below 2^bits − 1 | – |
//! | `read_noise_e`, `dark_current_e_s`, `dsnu_e` | e⁻, e⁻/s, e⁻ | 0 to 1e12 | – |
//! | `prnu` | 1 | 0 to below 1 | – |
//! | `mean_dark_e` | e⁻ | 0 to 1e12 | 0 |
//! | `doubling_k`, `reference_temperature_c` | K, °C | above 0 to 1000; −273.15 to 1000 | the dark current does not depend on the temperature |
//!
//! A pixel without a noise says so with a 0: nothing is assumed of a camera that its file does not state.

use super::decode::{Fields, Value};
use super::diagnostic::Diagnostics;
use super::files::{Files, normalised, root_of};
use super::reading::Reading;
use crate::sensor::Pixel;
use crate::sensor::pixel::MOST_BITS;

/// Most electrons of anything.
const LARGEST_E: f64 = 1e12;
/// Highest temperature, and largest difference of two.
const HOTTEST: f64 = 1000.0;
const ABSOLUTE_ZERO_C: f64 = -273.15;

const KEYS: [&str; 11] = [
    "gain_dn_per_e",
    "full_well_e",
    "bits",
    "black_dn",
    "read_noise_e",
    "dark_current_e_s",
    "reference_temperature_c",
    "doubling_k",
    "mean_dark_e",
    "dsnu_e",
    "prnu",
];

/// Reads a file that holds `Pixel(…)` alone. `path` is what `files` is asked for.
///
/// # Errors
/// Every problem of the file, at least one.
pub fn pixel_from_file(path: &str, files: &dyn Files) -> Result<Pixel, Diagnostics> {
    let path = normalised(path);
    let mut reading = Reading::new(files, &path, root_of(&path));
    let document = reading.first_document(&path, "pixel file");
    let pixel = document.and_then(|document| read_pixel(&Value::root(&document), &mut reading));
    match pixel {
        Some(pixel) if reading.problems.count() == 0 => Ok(pixel),
        _ => Err(reading.problems.finish()),
    }
}

/// A pixel.
pub(super) fn read_pixel(value: &Value, reading: &mut Reading) -> Option<Pixel> {
    let problems = &mut reading.problems;
    if value.name() != "Pixel" {
        let found = value.described();
        let form = "write `Pixel(gain_dn_per_e: 0.25, full_well_e: 14000, bits: 12, …)`";
        value.problem_at(&value.name_span(), problems, format!("a pixel is written as `Pixel(…)`, not {found}"), form);
        return None;
    }
    let fields = value.fields("`Pixel`", &KEYS, problems)?;
    let before = problems.count();
    let gain = number(&fields, "gain_dn_per_e", "0.25", "1e-9 to 1e9 DN/e⁻, such as `gain_dn_per_e: 0.25`", reading, |x| {
        (1e-9..=1e9).contains(&x)
    });
    let full_well = number(&fields, "full_well_e", "14000", "1 to 1e12 e⁻, such as `full_well_e: 14000`", reading, |x| {
        (1.0..=LARGEST_E).contains(&x)
    });
    let bits = number(&fields, "bits", "12", "a whole number from 1 to 16, such as `bits: 12`", reading, |x| {
        x.fract() == 0.0 && (1.0..=f64::from(MOST_BITS)).contains(&x)
    });
    let black = read_black(&fields, bits, reading);
    let noise = |key: &str, example: &str, unit: &str, reading: &mut Reading| {
        let allowed = format!("0 (none) to 1e12 {unit}, such as `{key}: {example}`");
        number(&fields, key, example, &allowed, reading, |x| (0.0..=LARGEST_E).contains(&x))
    };
    let read_noise = noise("read_noise_e", "8", "e⁻", reading);
    let dark_current = noise("dark_current_e_s", "30", "e⁻/s", reading);
    let dsnu = noise("dsnu_e", "3", "e⁻", reading);
    let prnu = number(&fields, "prnu", "0.008", "0 (none) to below 1, a ratio and no per cent, such as `prnu: 0.008`", reading, |x| {
        (0.0..1.0).contains(&x)
    });
    let mean_dark = if fields.get("mean_dark_e").is_some() { noise("mean_dark_e", "0", "e⁻", reading) } else { Some(0.0) };
    let temperature = read_temperature(&fields, reading);
    if reading.problems.count() > before {
        return None;
    }
    let (doubling_k, reference_temperature_c) = temperature?;
    Some(Pixel {
        gain_dn_per_e: gain?,
        full_well_e: full_well?,
        dark_current_e_s: dark_current?,
        reference_temperature_c,
        doubling_k,
        mean_dark_e: mean_dark?,
        read_noise_e: read_noise?,
        dsnu_e: dsnu?,
        prnu: prnu?,
        black_dn: black?,
        bits: bits? as u32,
    })
}

/// A number that must be given, within limits.
fn number(fields: &Fields, key: &str, example: &str, allowed: &str, reading: &mut Reading, holds: impl Fn(f64) -> bool) -> Option<f64> {
    let value = fields.require(key, example, &mut reading.problems)?;
    value.number_in(&format!("`{key}`"), allowed, holds, &mut reading.problems)
}

fn read_black(fields: &Fields, bits: Option<f64>, reading: &mut Reading) -> Option<f64> {
    let value = fields.require("black_dn", "64", &mut reading.problems)?;
    // Without the bits only what no ADC allows can be told.
    let bits = bits.unwrap_or(f64::from(MOST_BITS));
    let largest = bits.exp2() - 1.0;
    let allowed =
        format!("0 to below {largest}, the largest number of an ADC of {bits} bits, such as `black_dn: {}`", (largest / 64.0).floor());
    value.number_in("`black_dn`", &allowed, |x| x >= 0.0 && x < largest, &mut reading.problems)
}

/// Doubling and reference temperature of the dark current: both or neither.
fn read_temperature(fields: &Fields, reading: &mut Reading) -> Option<(f64, f64)> {
    let problems = &mut reading.problems;
    let (doubling, reference) = (fields.get("doubling_k"), fields.get("reference_temperature_c"));
    match (doubling, reference) {
        (None, None) => Some((f64::INFINITY, 20.0)),
        (Some(doubling), Some(reference)) => {
            let doubling =
                doubling.number_in("`doubling_k`", "above 0 to 1000 K, such as `doubling_k: 8`", |x| x > 0.0 && x <= HOTTEST, problems);
            let allowed = "-273.15 to 1000 °C, such as `reference_temperature_c: 30`";
            let range = ABSOLUTE_ZERO_C..=HOTTEST;
            let reference = reference.number_in("`reference_temperature_c`", allowed, |x| range.contains(&x), problems);
            Some((doubling?, reference?))
        }
        (doubling, _) => {
            let (given, missing) = if doubling.is_some() {
                ("doubling_k", "reference_temperature_c: 30")
            } else {
                ("reference_temperature_c", "doubling_k: 8")
            };
            fields.owner.problem_at(
                &fields.key_span(given),
                problems,
                format!("`{given}` alone does not say how the dark current goes with the temperature"),
                format!("add `{missing}`, or leave both out: the dark current is the same at every temperature then"),
            );
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::MemoryFiles;

    const GOOD: &str = "Pixel(gain_dn_per_e: 0.25, full_well_e: 14000, bits: 12, black_dn: 64, read_noise_e: 8, dark_current_e_s: 30,
        reference_temperature_c: 30, doubling_k: 8, dsnu_e: 3, prnu: 0.008)";

    fn read(text: &str) -> Result<Pixel, String> {
        pixel_from_file("p.ron", &MemoryFiles::new().with("p.ron", text)).map_err(|problems| problems.to_string())
    }

    #[test]
    fn a_pixel_is_read_with_its_temperature_or_without() {
        let pixel = read(GOOD).unwrap();
        assert_eq!((pixel.gain_dn_per_e, pixel.full_well_e, pixel.bits, pixel.black_dn), (0.25, 14000.0, 12, 64.0));
        assert_eq!((pixel.read_noise_e, pixel.dsnu_e, pixel.prnu, pixel.mean_dark_e), (8.0, 3.0, 0.008, 0.0));
        assert_eq!((pixel.dark_current_at(30.0), pixel.dark_current_at(38.0)), (30.0, 60.0));
        let constant = read(&GOOD.replace("reference_temperature_c: 30, doubling_k: 8,", "mean_dark_e: 2,")).unwrap();
        assert_eq!((constant.dark_current_at(-40.0), constant.dark_current_at(80.0), constant.mean_dark_e), (30.0, 30.0, 2.0));
    }

    #[test]
    fn what_no_pixel_can_have_is_told_with_what_is_allowed() {
        for (good, bad, message, help) in [
            ("full_well_e: 14000", "full_well_e: 0", "`full_well_e` is 0", "1 to 1e12 e⁻, such as `full_well_e: 14000`"),
            ("bits: 12", "bits: 0", "`bits` is 0", "a whole number from 1 to 16"),
            ("bits: 12", "bits: 40", "`bits` is 40", "a whole number from 1 to 16"),
            ("bits: 12", "bits: 9.5", "`bits` is 9.5", "a whole number from 1 to 16"),
            ("read_noise_e: 8", "read_noise_e: -8", "`read_noise_e` is -8", "0 (none) to 1e12 e⁻"),
            ("dsnu_e: 3", "dsnu_e: -3", "`dsnu_e` is -3", "0 (none) to 1e12 e⁻"),
            ("prnu: 0.008", "prnu: 8", "`prnu` is 8", "no per cent"),
            ("black_dn: 64", "black_dn: 4095", "`black_dn` is 4095", "0 to below 4095, the largest number of an ADC of 12 bits"),
            ("black_dn: 64", "black_dn: -1", "`black_dn` is -1", "such as `black_dn: 63`"),
            ("gain_dn_per_e: 0.25", "gain_dn_per_e: 0", "`gain_dn_per_e` is 0", "1e-9 to 1e9 DN/e⁻"),
            ("doubling_k: 8", "doubling_k: 0", "`doubling_k` is 0", "above 0 to 1000 K"),
            ("doubling_k: 8, ", "", "`reference_temperature_c` alone", "add `doubling_k: 8`, or leave both out"),
            ("reference_temperature_c: 30", "reference_temperature_c: -300", "is -300", "-273.15 to 1000 °C"),
            ("dsnu_e: 3, ", "", "`Pixel` has no `dsnu_e`", "add `dsnu_e: 3`"),
            ("prnu:", "pnru:", "unknown key `pnru`", "did you mean `prnu`?"),
            ("Pixel(", "Pixl(", "a pixel is written as `Pixel(…)`", "write `Pixel("),
            ("bits: 12", "bits: \"12\"", "a number is expected", ""),
        ] {
            assert!(GOOD.contains(good), "{good}");
            let words = read(&GOOD.replace(good, bad)).unwrap_err();
            assert!(words.contains(message) && words.contains(help), "{bad}:\n{words}");
            assert_eq!(words.matches("error:").count(), 1, "{words}");
        }
    }

    #[test]
    fn all_problems_are_told_at_once() {
        let words = read("Pixel(gain_dn_per_e: -1, full_well_e: 0, bits: 40, black_dn: -5, read_noise_e: -1, prnu: 2)").unwrap_err();
        assert_eq!(words.matches("error:").count(), 8, "{words}");
    }
}

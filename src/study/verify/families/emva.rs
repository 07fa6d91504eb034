//! Group g6: the linear camera model of EMVA 1288, and the split of its spatial variance. The quantity of a case says what of it is asked.

use super::{Families, Outcome};
use crate::sensor::LinearModel;
use crate::sensor::pixel::spatial::SpatialSplit;
use crate::sensor::pixel::{Pixel, decibels, light, saturation};
use crate::study::verify::case::{Case, Fault};

pub(super) const FAMILIES: Families = &[
    ("g6a.S1", camera),
    ("g6a.S2", camera),
    ("g6b.split-pix", split),
    ("g6b.split-col", split),
    ("g6b.split-row", split),
    ("g6b.split-sum", split),
];

/// Temperatures stand in the title: "dark current at T=45C with reference at 30C, doubling 8 C".
fn temperatures(title: &str) -> Result<[f64; 3], Fault> {
    let numbers: Vec<f64> = title.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter_map(|word| word.parse().ok()).collect();
    numbers.try_into().map_err(|_| Fault::wrong(format!("three temperatures are expected in `{title}`")))
}

fn pixel(c: &Case) -> Result<Pixel, Fault> {
    let bits = c.input("bits")?;
    let bits = bits.as_u64().and_then(|bits| u32::try_from(bits).ok()).ok_or_else(|| Fault::wrong(format!("`bits` is {bits}")))?;
    Ok(Pixel {
        dark_current_e_s: c.number("dark_current_e_s")?,
        mean_dark_e: c.number("mu_d0_e")?,
        read_noise_e: c.number("sigma_d0")?,
        dsnu_e: c.number("DSNU_e")?,
        prnu: c.number("PRNU")?,
        ..Pixel::ideal(c.number("K")?, c.number("full_well_e")?, c.number("black_DN")?, bits)
    })
}

fn camera(c: &Case) -> Outcome {
    let (pixel, efficiency, exposure_s) = (pixel(c)?, c.number("eta")?, c.number("exposure_s")?);
    let model = pixel.linear(exposure_s, pixel.reference_temperature_c);
    let hard_e = model.hard_limit_e();
    let at_fraction = |of: fn(&LinearModel, f64) -> f64| Ok::<f64, Fault>(of(&model, c.number("fraction")? * hard_e));
    // Levels are numbered: `snr_3` is the SNR at the third.
    let (level, numbered) = c.quantity().rsplit_once('_').unwrap_or_default();
    let level = if numbered.parse::<u32>().is_ok() { level } else { c.quantity() };
    Ok(match level {
        "mu_y_dark" => model.expected_dn(0.0),
        "sigma_y_dark" => model.variance_dn2(0.0).sqrt(),
        "R" => pixel.responsivity_dn_per_photon(efficiency),
        "mu_p_min" => model.threshold_photons(efficiency),
        "mu_e_sat_hard" => hard_e,
        "SNR_max" => hard_e.sqrt(),
        "SNR_max_dB" => decibels(hard_e.sqrt()),
        "DR" => model.dynamic_range(hard_e),
        "snr" => at_fraction(LinearModel::snr)?,
        "snr_total" => at_fraction(LinearModel::snr_total)?,
        "var" => at_fraction(LinearModel::variance_dn2)?,
        "mu_p" => {
            let (irradiance_w_m2, area_m2) = (c.number("E_uW_cm2")? * 1e-2, c.number("pixel_um2")? * 1e-12);
            light::photons(irradiance_w_m2, area_m2, exposure_s, c.number("lambda_nm")?)
        }
        "mu_e.sat (EMVA)" => model.saturation_e(),
        "Var" => saturation::clipped_normal(hard_e, hard_e + model.dark_variance_e2(), hard_e).1,
        "thermal" => {
            let [at_c, reference_temperature_c, doubling_k] = temperatures(c.title())?;
            Pixel { reference_temperature_c, doubling_k, ..pixel }.dark_current_at(at_c)
        }
        other if other.starts_with("E_fnumber") => light::irradiance_at_f_number(c.number("L")?, c.number("N")?),
        other => return Err(Fault::wrong(format!("no quantity `{other}`"))),
    }
    .into())
}

fn split(c: &Case) -> Outcome {
    let [rows, columns, column_means, row_means, whole] =
        [c.number("M")?, c.number("N")?, c.number("s2_cav")?, c.number("s2_rav")?, c.number("s2")?];
    let split = SpatialSplit::of(whole, column_means, row_means, rows as u64, columns as u64);
    let split = split.ok_or_else(|| Fault::wrong("the image is too small to be split"))?;
    Ok(match c.quantity() {
        "s2_pix" => split.pixel,
        "s2_col" => split.column,
        "s2_row" => split.row,
        "s2" => split.sum(),
        other => return Err(Fault::wrong(format!("no quantity `{other}`"))),
    }
    .into())
}

//! Phases of daylight, the CIE D series: `S(λ) = S₀(λ) + M₁ S₁(λ) + M₂ S₂(λ)` (CIE 015:2018, section 4.1.2).
//!
//! | step | formula |
//! |---|---|
//! | x_D, 4000 K to 7000 K | `−4.6070·10⁹/T³ + 2.9678·10⁶/T² + 0.09911·10³/T + 0.244063` |
//! | x_D, 7000 K to 25000 K | `−2.0064·10⁹/T³ + 1.9018·10⁶/T² + 0.24748·10³/T + 0.237040` |
//! | y_D | `−3.000 x_D² + 2.870 x_D − 0.275` |
//! | M₁ | `(−1.3515 − 1.7703 x_D + 5.9114 y_D)/(0.0241 + 0.2562 x_D − 0.7341 y_D)` |
//! | M₂ | `(0.0300 − 31.4424 x_D + 30.0717 y_D)/(0.0241 + 0.2562 x_D − 0.7341 y_D)` |
//!
//! * **Temperature.** The names of D50, D55, D65 and D75 come from the time when c₂ was 1.4380 cm K. The tabulated illuminants are those
//!   at the nominal temperature times 1.4388/1.4380: D65 is `daylight(6500.0 * 1.4388 / 1.4380)`, about 6504 K, and D50 is at 5003 K.
//! * **Rounding.** M₁ and M₂ are not rounded. The CIE's tables round them to three decimals before S(λ) is formed, so that they differ
//!   from these spectra in the fourth digit.
//! * **Between and beyond the rows** of S₀, S₁ and S₂ the spectrum is linear, and zero outside their range.

use super::{Density, Factor, Outside, SpectrumError, Table, library};

/// Correlated colour temperatures for which the series is defined, K.
pub const RANGE_K: (f64, f64) = (4000.0, 25000.0);

/// Factor between the nominal temperature of D50, D55, D65 and D75 and the temperature to be inserted: c₂ of the temperature scales since
/// 1968 over c₂ of the scale of 1948, `1.4388/1.4380`.
pub const NOMINAL_TO_CCT: f64 = 1.4388 / 1.4380;

/// Chromaticity (x_D, y_D) of the phase of daylight at a correlated colour temperature in K. Errors outside [`RANGE_K`].
pub fn chromaticity(cct_k: f64) -> Result<(f64, f64), SpectrumError> {
    if !(RANGE_K.0..=RANGE_K.1).contains(&cct_k) {
        let name = "the correlated colour temperature of the phase of daylight in K";
        return Err(SpectrumError::Parameter { name, value: cct_k, allowed: "from 4000 to 25000, the range of the CIE's D series" });
    }
    let t = 1.0 / cct_k;
    let x_d = if cct_k <= 7000.0 {
        ((-4.6070e9 * t + 2.9678e6) * t + 0.09911e3) * t + 0.244063
    } else {
        ((-2.0064e9 * t + 1.9018e6) * t + 0.24748e3) * t + 0.237040
    };
    Ok((x_d, (-3.000 * x_d + 2.870) * x_d - 0.275))
}

/// (M₁, M₂), not rounded, of a chromaticity (x_D, y_D).
pub fn coefficients(x_d: f64, y_d: f64) -> (f64, f64) {
    let m = 0.0241 + 0.2562 * x_d - 0.7341 * y_d;
    ((-1.3515 - 1.7703 * x_d + 5.9114 * y_d) / m, (0.0300 - 31.4424 * x_d + 30.0717 * y_d) / m)
}

impl Density {
    /// The phase of daylight at a correlated colour temperature in K, relative, 100 at 560 nm. For D65 insert
    /// `6500.0 * daylight::NOMINAL_TO_CCT`; see the head of [`daylight`](super::daylight).
    ///
    /// # Errors
    /// [`SpectrumError::Parameter`] outside 4000 K to 25000 K.
    pub fn daylight(cct_k: f64) -> Result<Self, SpectrumError> {
        let (x_d, y_d) = chromaticity(cct_k)?;
        let (m1, m2) = coefficients(x_d, y_d);
        let [s0, s1, s2] = [basis("D series S0")?, basis("D series S1")?, basis("D series S2")?];
        let values = s0.rows().map(|(nm, value)| value + m1 * s1.at(nm) + m2 * s2.at(nm)).collect();
        Density::table(Table::new(s0.wavelengths_nm().to_vec(), values, Outside::Zero)?)
    }
}

/// One of the three basis functions.
fn basis(name: &'static str) -> Result<Table, SpectrumError> {
    match library::factor(name) {
        Ok(Factor::Table(table)) => Ok(table),
        _ => Err(SpectrumError::NoTable { name }),
    }
}

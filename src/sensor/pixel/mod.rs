//! A camera pixel as EMVA 1288 sees it: the linear camera model.
//!
//! ```text
//! μ_y   = y₀ + K (μ_d0 + μ_I t + μ_e)                        mean grey value, DN
//! σ_y²  = K² (σ_d0² + μ_I t + μ_e) + 1/12                    temporal variance, DN²
//! μ_I   = μ_I.ref 2^((T − T_ref)/T_d)                        dark current, e⁻/s
//! μ_e   = η μ_p,   μ_p = E A t λ/(hc)                        photo-electrons, photons
//! SNR   = μ_e / √(σ_y²/K²),   SNR_total = μ_e / √(σ_y²/K² + DSNU² + PRNU² μ_e²)
//! ```
//!
//! | symbol | field | unit |
//! |---|---|---|
//! | K | `gain_dn_per_e` | DN/e⁻ |
//! | full well | `full_well_e` | e⁻ |
//! | μ_I.ref, T_ref, T_d | `dark_current_e_s`, `reference_temperature_c`, `doubling_k` | e⁻/s, °C, K |
//! | μ_d0 | `mean_dark_e`: an offset of the readout, without shot noise and outside the well | e⁻ |
//! | σ_d0 | `read_noise_e` | e⁻ |
//! | DSNU, PRNU | `dsnu_e`, `prnu` | e⁻, 1 |
//! | y₀ | `black_dn` | DN |
//! | bits of the ADC | `bits` | 1 |
//!
//! The quantum efficiency η belongs to the channel in front of the pixel, so functions of photons take it as an argument.
//!
//! | file | what |
//! |---|---|
//! | `saturation.rs` | hard limit, clipped normal distribution, variance peak, threshold, dynamic range |
//! | `codes.rs` | the exact distribution of the digital numbers of one pixel, and its mean and variance |
//! | `light.rs` | photons from an irradiance, irradiance at an f-number |
//! | `spatial.rs` | the split of a spatial variance into columns, rows and pixels |
//!
//! Source: EMVA Standard 1288, release 4.0 linear (2021), sections 2 and 3. Its text was not at hand when this was written: the formulas
//! are those of the published releases as the package emva1288 1.0.2 computes them, and reference cases by a second route.
//!
//! ```
//! use etendue::sensor::Pixel;
//!
//! let pixel = Pixel { dark_current_e_s: 30.0, read_noise_e: 8.0, ..Pixel::ideal(0.25, 14000.0, 64.0, 12) };
//! let model = pixel.linear(0.01, pixel.reference_temperature_c);
//! assert!((model.expected_dn(0.0) - 64.075).abs() < 1e-9);
//! assert!((model.variance_dn2(1000.0) - (0.0625 * (64.0 + 0.3 + 1000.0) + 1.0 / 12.0)).abs() < 1e-9);
//! ```

pub mod codes;
pub mod light;
pub mod saturation;
pub mod spatial;

pub use codes::Codes;

/// Variance of the rounding to whole digital numbers, DN².
pub const QUANTISATION_DN2: f64 = 1.0 / 12.0;

/// Most bits of an ADC: frames hold 16 bits a pixel.
pub const MOST_BITS: u32 = 16;

/// A pixel with its readout. Every number is finite; which range each has is said at its field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Overall system gain K, DN/e⁻, above 0.
    pub gain_dn_per_e: f64,
    /// Charge that the well holds, e⁻, above 0.
    pub full_well_e: f64,
    /// Dark current at the reference temperature, e⁻/s, 0 or more.
    pub dark_current_e_s: f64,
    /// Temperature of `dark_current_e_s`, °C.
    pub reference_temperature_c: f64,
    /// Rise of temperature that doubles the dark current, K, above 0; infinite if it does not depend on the temperature.
    pub doubling_k: f64,
    /// Mean dark signal of an exposure without time, e⁻, 0 or more.
    pub mean_dark_e: f64,
    /// Standard deviation of the readout, e⁻, 0 or more.
    pub read_noise_e: f64,
    /// Standard deviation of the dark signal over the pixels, e⁻, 0 or more.
    pub dsnu_e: f64,
    /// Standard deviation of the responsivity over the pixels, relative, 0 or more.
    pub prnu: f64,
    /// Digital number of no electrons, DN, from 0 to below the largest number of the ADC.
    pub black_dn: f64,
    /// Bits of the ADC, 1 to [`MOST_BITS`].
    pub bits: u32,
}

impl Pixel {
    /// A pixel without dark current, read noise and pattern: shot noise, rounding and the two limits remain.
    #[must_use]
    pub fn ideal(gain_dn_per_e: f64, full_well_e: f64, black_dn: f64, bits: u32) -> Pixel {
        Pixel {
            gain_dn_per_e,
            full_well_e,
            dark_current_e_s: 0.0,
            reference_temperature_c: 20.0,
            doubling_k: 8.0,
            mean_dark_e: 0.0,
            read_noise_e: 0.0,
            dsnu_e: 0.0,
            prnu: 0.0,
            black_dn,
            bits,
        }
    }

    /// Largest digital number, `2^bits − 1`.
    #[must_use]
    pub fn largest_dn(&self) -> f64 {
        f64::from((1u32 << self.bits.clamp(1, MOST_BITS)) - 1)
    }

    /// Dark current μ_I at a temperature of the sensor, e⁻/s.
    #[must_use]
    pub fn dark_current_at(&self, temperature_c: f64) -> f64 {
        if self.dark_current_e_s == 0.0 {
            return 0.0;
        }
        self.dark_current_e_s * ((temperature_c - self.reference_temperature_c) / self.doubling_k).exp2()
    }

    /// The linear model at an exposure time in seconds, 0 or more, and a temperature in °C.
    #[must_use]
    pub fn linear(&self, exposure_s: f64, temperature_c: f64) -> LinearModel {
        LinearModel { pixel: *self, thermal_e: self.dark_current_at(temperature_c) * exposure_s }
    }

    /// Mean grey value, DN, of `electrons_e` photo-electrons: [`LinearModel::expected_dn`].
    #[must_use]
    pub fn expected_dn(&self, electrons_e: f64, exposure_s: f64, temperature_c: f64) -> f64 {
        self.linear(exposure_s, temperature_c).expected_dn(electrons_e)
    }

    /// Temporal variance, DN², of `electrons_e` photo-electrons: [`LinearModel::variance_dn2`].
    #[must_use]
    pub fn variance_dn2(&self, electrons_e: f64, exposure_s: f64, temperature_c: f64) -> f64 {
        self.linear(exposure_s, temperature_c).variance_dn2(electrons_e)
    }

    /// Responsivity R = K η, DN per photon, of a quantum efficiency in 0 … 1.
    #[must_use]
    pub fn responsivity_dn_per_photon(&self, quantum_efficiency: f64) -> f64 {
        self.gain_dn_per_e * quantum_efficiency
    }
}

/// A pixel at one exposure time and temperature: closed forms of the linear model, below saturation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearModel {
    /// The pixel.
    pub pixel: Pixel,
    /// Mean electrons of the dark current in the exposure, μ_I t, e⁻.
    pub thermal_e: f64,
}

impl LinearModel {
    /// Mean dark signal μ_d = μ_d0 + μ_I t, e⁻.
    #[must_use]
    pub fn mean_dark_e(&self) -> f64 {
        self.pixel.mean_dark_e + self.thermal_e
    }

    /// Variance of the dark signal before the ADC, σ_d² = σ_d0² + μ_I t, e⁻².
    #[must_use]
    pub fn dark_variance_e2(&self) -> f64 {
        self.pixel.read_noise_e * self.pixel.read_noise_e + self.thermal_e
    }

    /// Mean grey value μ_y, DN, before any limit.
    #[must_use]
    pub fn expected_dn(&self, electrons_e: f64) -> f64 {
        self.pixel.black_dn + self.pixel.gain_dn_per_e * (self.mean_dark_e() + electrons_e)
    }

    /// Temporal variance σ_y², DN², before any limit, with the quantisation as 1/12 DN². Where the noise is below about 0.4 DN, rounding
    /// is no independent noise any more: [`codes`](LinearModel::codes) is exact there.
    #[must_use]
    pub fn variance_dn2(&self, electrons_e: f64) -> f64 {
        self.pixel.gain_dn_per_e.powi(2) * (self.dark_variance_e2() + electrons_e) + QUANTISATION_DN2
    }

    /// Temporal variance σ_y²/K² referred to electrons, e⁻².
    #[must_use]
    pub fn variance_e2(&self, electrons_e: f64) -> f64 {
        self.dark_variance_e2() + electrons_e + QUANTISATION_DN2 / self.pixel.gain_dn_per_e.powi(2)
    }

    /// Temporal signal-to-noise ratio of `electrons_e` photo-electrons.
    #[must_use]
    pub fn snr(&self, electrons_e: f64) -> f64 {
        electrons_e / self.variance_e2(electrons_e).sqrt()
    }

    /// Signal-to-noise ratio over the pixels of one frame: with DSNU and PRNU.
    #[must_use]
    pub fn snr_total(&self, electrons_e: f64) -> f64 {
        let pattern_e2 = self.pixel.dsnu_e.powi(2) + (self.pixel.prnu * electrons_e).powi(2);
        electrons_e / (self.variance_e2(electrons_e) + pattern_e2).sqrt()
    }
}

/// A ratio of amplitudes in decibels, `20 lg x`.
#[must_use]
pub fn decibels(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}

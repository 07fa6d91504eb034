//! Dominant wavelength and purity: where the ray from a white through the light meets the spectral locus.
//!
//! ```text
//! p_e = |p − w|/|b − w|          excitation purity: b is where the ray leaves the diagram
//! p_c = p_e y_b/y                colorimetric purity
//! ```
//!
//! | the ray leaves through | result |
//! |---|---|
//! | the spectral locus, 380–780 nm | the dominant wavelength |
//! | the purple line between its ends | the complementary wavelength: where the ray in the other direction meets the locus |
//!
//! Between two rows of the observer's tables the chromaticities of single wavelengths lie on a straight line, so the crossing is solved for
//! exactly. At the red end, where the locus folds back on itself, the crossing nearest to its middle is taken. Definitions: CIE S 017,
//! 17-23-062 to 17-23-066; CIE 015:2018, section 9.

use super::{Chromaticity, LOCUS_RANGE_NM, Tristimulus};
use crate::spectrum::Factor;

/// Chromaticities are good to about twelve digits; a light this near to white (as purity) has no direction from it.
const WHITE: f64 = 1e-10;
/// Between the two ends of the locus the crossing that is nearest to this wavelength counts.
const MIDDLE_NM: f64 = 550.0;

/// What a light looks like on the ring of hues.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hue {
    /// A spectral hue: the dominant wavelength, nm.
    Spectral(f64),
    /// A purple: the complementary wavelength, nm.
    Purple(f64),
}

/// Dominant or complementary wavelength with the purities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DominantWavelength {
    /// Dominant wavelength, or the complementary one of a purple.
    pub hue: Hue,
    /// Excitation purity: 0 at the white, 1 on the boundary.
    pub excitation_purity: f64,
    /// Colorimetric purity, the share of the boundary light's luminance.
    pub colorimetric_purity: f64,
    /// Where the ray leaves the diagram.
    pub boundary: Chromaticity,
}

/// Dominant wavelength and purity of one light; see [`SpectralLocus::dominant_wavelength`].
pub fn dominant_wavelength(light: Chromaticity, white: Chromaticity, matching: &[Factor; 3]) -> Option<DominantWavelength> {
    SpectralLocus::new(matching).dominant_wavelength(light, white)
}

/// The single wavelengths as an observer sees them: tristimulus values in rows between which they are linear.
#[derive(Debug, Clone)]
pub struct SpectralLocus {
    wavelengths_nm: Vec<f64>,
    rows: Vec<[f64; 3]>,
}

impl SpectralLocus {
    /// The locus of an observer between the ends of [`LOCUS_RANGE_NM`], as far as the observer sees.
    pub fn new(matching: &[Factor; 3]) -> Self {
        let (from_nm, to_nm) = LOCUS_RANGE_NM;
        let mut wavelengths_nm: Vec<f64> =
            matching.iter().flat_map(Factor::breakpoints).filter(|nm| (from_nm..=to_nm).contains(nm)).collect();
        wavelengths_nm.sort_by(f64::total_cmp);
        wavelengths_nm.dedup();
        let row = |nm: f64| matching.each_ref().map(|function| function.at(nm));
        wavelengths_nm.retain(|nm| row(*nm).iter().sum::<f64>() > 0.0);
        let rows = wavelengths_nm.iter().map(|nm| row(*nm)).collect();
        Self { wavelengths_nm, rows }
    }

    /// Dominant wavelength and purity of a light against a white.
    ///
    /// `None` where there is no direction: the light is the white, the white lies outside the diagram, or a value is not finite.
    pub fn dominant_wavelength(&self, light: Chromaticity, white: Chromaticity) -> Option<DominantWavelength> {
        let (dx, dy) = (light.x - white.x, light.y - white.y);
        let (hue, boundary) = match self.crossing(white, dx, dy) {
            Some((nm, point)) => (Hue::Spectral(nm), point),
            None => {
                let point = self.purple_crossing(white, dx, dy)?;
                (Hue::Purple(self.crossing(white, -dx, -dy)?.0), point)
            }
        };
        let excitation_purity = dx.hypot(dy) / boundary.distance(&white);
        (excitation_purity.is_finite() && excitation_purity > WHITE).then_some(DominantWavelength {
            hue,
            excitation_purity,
            colorimetric_purity: excitation_purity * boundary.y / light.y,
            boundary,
        })
    }

    /// Where the ray from `white` along (dx, dy) meets the spectral locus: wavelength in nm and chromaticity.
    fn crossing(&self, white: Chromaticity, dx: f64, dy: f64) -> Option<(f64, Chromaticity)> {
        // Zero where a wavelength lies on the line through white; linear between rows because the sum X + Y + Z is multiplied in.
        let side = |[x, y, z]: [f64; 3]| {
            let sum = x + y + z;
            dx * (y - white.y * sum) - dy * (x - white.x * sum)
        };
        let mut best: Option<(f64, Chromaticity)> = None;
        for (rows, nm) in self.rows.windows(2).zip(self.wavelengths_nm.windows(2)) {
            let (low, high) = (side(rows[0]), side(rows[1]));
            if low == high || (low > 0.0 && high > 0.0) || (low < 0.0 && high < 0.0) {
                continue;
            }
            let t = low / (low - high);
            let mixed: [f64; 3] = std::array::from_fn(|i| rows[0][i] + t * (rows[1][i] - rows[0][i]));
            let Some(point) = Tristimulus::from(mixed).chromaticity() else { continue };
            let ahead = dx * (point.x - white.x) + dy * (point.y - white.y) > 0.0;
            let found_nm = nm[0] + t * (nm[1] - nm[0]);
            if ahead && best.is_none_or(|(nm, _)| (found_nm - MIDDLE_NM).abs() < (nm - MIDDLE_NM).abs()) {
                best = Some((found_nm, point));
            }
        }
        best
    }

    /// Where the ray from `white` along (dx, dy) meets the line between the ends of the locus.
    fn purple_crossing(&self, white: Chromaticity, dx: f64, dy: f64) -> Option<Chromaticity> {
        let blue = Tristimulus::from(*self.rows.first()?).chromaticity()?;
        let red = Tristimulus::from(*self.rows.last()?).chromaticity()?;
        let side = |point: &Chromaticity| dx * (point.y - white.y) - dy * (point.x - white.x);
        let (low, high) = (side(&blue), side(&red));
        let t = low / (low - high);
        let point = Chromaticity { x: blue.x + t * (red.x - blue.x), y: blue.y + t * (red.y - blue.y) };
        let ahead = dx * (point.x - white.x) + dy * (point.y - white.y) > 0.0;
        ((0.0..=1.0).contains(&t) && ahead).then_some(point)
    }
}

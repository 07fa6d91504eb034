//! Pinholes and thin lenses: which ray of the scene reaches which point of the image, and how much of it.
//!
//! ```text
//! 1/f = 1/v + 1/D                                       v: image plane behind the pupil, D: focus plane in front of it
//! slope of the ray that leaves the pupil at p for image point a:     a/v − p/D       (pinhole: straight on, 1/D = −1/v)
//! image point of a ray from a point at slope s and depth z:          v (s + p (1/D − 1/z))
//! E = (T/A_pix) ∫∫ L cosθ cosθ′/d² dA_y dA_x            cosθ = cosθ′ = v/d,  d² = v² + |a + p|²
//! ```
//!
//! | parameter | meaning | unit |
//! |---|---|---|
//! | `focal_length_m` | f | m |
//! | `f_number` | N; the pupil is a disc of diameter f/N in the plane of the lens | 1 |
//! | `focus_m` | D, above f, or infinite | m |
//! | `distance_m`, `diameter_m` | of a pinhole from the image plane, and its own | m |
//!
//! Image points are given upright: the sensor itself is upside down behind the pupil, at −a. The fall-off towards the corners (cos⁴θ
//! for a small pupil) comes out of the integral. Not modelled: diffraction, aberrations, the thickness of real lenses, stray light.
//!
//! ```
//! use etendue::sensor::camera::Lens;
//! let lens = Lens::Thin { focal_length_m: 0.05, f_number: 2.0, focus_m: 1.05 };
//! assert!((lens.image_distance_m() - 0.0525).abs() < 1e-15);
//! // A point in the focus plane is sharp: the same image point from everywhere on the pupil.
//! let image = lens.image_of([0.1, 0.0], 1.0 / 1.05, [0.0, 0.0]);
//! let from_the_rim = lens.image_of([0.1, 0.0], 1.0 / 1.05, [0.0, 0.0125]);
//! assert!((image[0] - 0.00525).abs() < 1e-15 && (image[1] - from_the_rim[1]).abs() < 1e-15);
//! ```

use std::f64::consts::PI;

/// What forms the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// A hole, through which rays go straight on.
    Pinhole {
        /// From the hole to the image plane, m.
        distance_m: f64,
        /// Of the hole, m.
        diameter_m: f64,
    },
    /// An ideal thin lens.
    Thin {
        /// f, m.
        focal_length_m: f64,
        /// f over the diameter of the pupil.
        f_number: f64,
        /// From the lens to the plane that is sharp, m; above f, or infinite.
        focus_m: f64,
    },
}

impl Lens {
    /// v, from the pupil to the image plane, m.
    #[must_use]
    pub fn image_distance_m(&self) -> f64 {
        match *self {
            Lens::Pinhole { distance_m, .. } => distance_m,
            Lens::Thin { focal_length_m, focus_m, .. } => focal_length_m / (1.0 - focal_length_m / focus_m),
        }
    }

    /// Radius of the pupil, m.
    #[must_use]
    pub fn pupil_radius_m(&self) -> f64 {
        match *self {
            Lens::Pinhole { diameter_m, .. } => 0.5 * diameter_m,
            Lens::Thin { focal_length_m, f_number, .. } => 0.5 * focal_length_m / f_number,
        }
    }

    /// Area of the pupil, m².
    #[must_use]
    pub fn pupil_area_m2(&self) -> f64 {
        PI * self.pupil_radius_m().powi(2)
    }

    /// 1/D, 1/m: zero for a lens focused at infinity, −1/v for a pinhole.
    #[must_use]
    pub fn vergence_1_m(&self) -> f64 {
        match *self {
            Lens::Pinhole { distance_m, .. } => -1.0 / distance_m,
            Lens::Thin { focus_m, .. } => 1.0 / focus_m,
        }
    }

    /// Metres to the right and up per metre forwards, of the ray that leaves the pupil at `pupil_m` for the image point `image_m`.
    #[inline(always)]
    #[must_use]
    pub fn slope(&self, image_m: [f64; 2], pupil_m: [f64; 2]) -> [f64; 2] {
        let (v, vergence) = (self.image_distance_m(), self.vergence_1_m());
        [image_m[0] / v - pupil_m[0] * vergence, image_m[1] / v - pupil_m[1] * vergence]
    }

    /// Where the light of a point lands, m: `slope` is its place to the right and up over its depth, `inverse_depth_1_m` one over its
    /// depth along the axis, zero for light from infinitely far away.
    #[must_use]
    pub fn image_of(&self, slope: [f64; 2], inverse_depth_1_m: f64, pupil_m: [f64; 2]) -> [f64; 2] {
        let (v, blur) = (self.image_distance_m(), self.vergence_1_m() - inverse_depth_1_m);
        [v * (slope[0] + pupil_m[0] * blur), v * (slope[1] + pupil_m[1] * blur)]
    }

    /// The pupil's area times cosθ cosθ′/d², sr: the mean over pupil and pixel times a radiance is the irradiance of the pixel.
    #[inline(always)]
    #[must_use]
    pub fn weight_sr(&self, image_m: [f64; 2], pupil_m: [f64; 2]) -> f64 {
        let v = self.image_distance_m();
        let tangent2 = ((image_m[0] + pupil_m[0]).powi(2) + (image_m[1] + pupil_m[1]).powi(2)) / (v * v);
        self.pupil_area_m2() / (v * v) / (1.0 + tangent2).powi(2)
    }

    /// The mean of [`weight_sr`](Self::weight_sr) over the pupil, sr: the projected solid angle of a disc from a point of a parallel plane.
    ///
    /// `∫ v²/d⁴ dA = 2π R²v² / (S (S + a² + v² − R²)),   S² = (a² + v² + R²)² − 4 a²R²`
    #[must_use]
    pub fn mean_weight_sr(&self, image_m: [f64; 2]) -> f64 {
        let v = self.image_distance_m();
        let a2 = (image_m[0] * image_m[0] + image_m[1] * image_m[1]) / (v * v);
        let r2 = (self.pupil_radius_m() / v).powi(2);
        let s = ((1.0 + a2 + r2).powi(2) - 4.0 * a2 * r2).sqrt();
        2.0 * PI * r2 / (s * (s + 1.0 + a2 - r2))
    }

    /// Tangent of the angle of incidence on the sensor and its azimuth, rad, from the right towards up.
    #[must_use]
    pub fn incidence(&self, image_m: [f64; 2], pupil_m: [f64; 2]) -> (f64, f64) {
        let (x, y) = (image_m[0] + pupil_m[0], image_m[1] + pupil_m[1]);
        (x.hypot(y) / self.image_distance_m(), y.atan2(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rays_and_images_are_inverse(
            a in (-0.01..0.01_f64, -0.01..0.01_f64), p in (-0.01..0.01_f64, -0.01..0.01_f64), depth in 0.1..100.0_f64, focus in 0.06..50.0_f64, kind in 0..3_u8,
        ) {
            let lens = match kind {
                0 => Lens::Pinhole { distance_m: 0.05, diameter_m: 0.001 },
                1 => Lens::Thin { focal_length_m: 0.05, f_number: 2.0, focus_m: focus },
                _ => Lens::Thin { focal_length_m: 0.05, f_number: 2.0, focus_m: f64::INFINITY },
            };
            let (image, pupil) = ([a.0, a.1], [p.0, p.1]);
            let slope = lens.slope(image, pupil);
            // Where the ray is at that depth, over the depth.
            let at = [slope[0] + pupil[0] / depth, slope[1] + pupil[1] / depth];
            let back = lens.image_of(at, 1.0 / depth, pupil);
            prop_assert!((back[0] - image[0]).abs() < 1e-12 && (back[1] - image[1]).abs() < 1e-12, "{back:?} against {image:?}");
        }
    }

    #[test]
    fn the_mean_over_the_pupil_has_a_closed_form() {
        let lens = Lens::Thin { focal_length_m: 0.02, f_number: 0.7, focus_m: 0.5 };
        for a in [0.0, 0.003, 0.02, 0.05] {
            let n = 400;
            let ring = |k: usize| {
                let radius = lens.pupil_radius_m() * ((k / n) as f64 + 0.5).sqrt() / (n as f64).sqrt();
                let (sin, cos) = (2.0 * PI * ((k % n) as f64 + 0.5) / n as f64).sin_cos();
                lens.weight_sr([a, 0.0], [radius * cos, radius * sin])
            };
            let mean = (0..n * n).map(ring).sum::<f64>() / (n * n) as f64;
            let found = lens.mean_weight_sr([0.6 * a, 0.8 * a]);
            assert!((found / mean - 1.0).abs() < 1e-6, "{a}: {found} against {mean}");
        }
    }

    #[test]
    fn a_small_pupil_falls_off_with_the_fourth_power_of_the_cosine() {
        let lens = Lens::Pinhole { distance_m: 0.02, diameter_m: 1e-6 };
        for tangent in [0.1, 0.5, 1.0, 2.0_f64] {
            let ratio = lens.weight_sr([0.02 * tangent, 0.0], [0.0, 0.0]) / lens.weight_sr([0.0, 0.0], [0.0, 0.0]);
            assert!((ratio - tangent.atan().cos().powi(4)).abs() < 1e-14);
        }
    }
}

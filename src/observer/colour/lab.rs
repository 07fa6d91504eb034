//! CIELAB, and the distance of two colours in it.
//!
//! ```text
//! L* = 116 f(Y/Yₙ) − 16,   a* = 500 (f(X/Xₙ) − f(Y/Yₙ)),   b* = 200 (f(Y/Yₙ) − f(Z/Zₙ))
//! f(t) = t^⅓  above (6/29)³,   (29/6)² t/3 + 4/29  below          ΔE*ab = √(ΔL*² + Δa*² + Δb*²)
//! ```
//!
//! X_n, Y_n, Z_n: the white. Source: CIE 015:2018, 8.2.1.

use super::Tristimulus;

/// A colour in CIELAB, relative to a white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// L*, 0 for black to 100 for the white.
    pub lightness: f64,
    /// a*, green (negative) to red.
    pub a: f64,
    /// b*, blue (negative) to yellow.
    pub b: f64,
}

impl Lab {
    /// Of a colour beside its `white`, in the same unit. `None` if the white lacks X, Y or Z.
    #[must_use]
    pub fn of(colour: &Tristimulus, white: &Tristimulus) -> Option<Lab> {
        let white = white.to_array();
        if !white.iter().all(|part| part.is_finite() && *part > 0.0) {
            return None;
        }
        let colour = colour.to_array();
        let [x, y, z] = [0, 1, 2].map(|i| f(colour[i] / white[i]));
        Some(Lab { lightness: 116.0 * y - 16.0, a: 500.0 * (x - y), b: 200.0 * (y - z) })
    }

    /// ΔE*ab.
    #[must_use]
    pub fn distance(&self, other: &Lab) -> f64 {
        (self.lightness - other.lightness).hypot(self.a - other.a).hypot(self.b - other.b)
    }
}

fn f(t: f64) -> f64 {
    const EDGE: f64 = 6.0 / 29.0;
    if t > EDGE * EDGE * EDGE { t.cbrt() } else { t / (3.0 * EDGE * EDGE) + 4.0 / 29.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_black_is_black_and_the_two_branches_meet() {
        let white = Tristimulus { x: 95.047, y: 100.0, z: 108.883 };
        let of = |share: f64| Lab::of(&white.scaled(share), &white).unwrap();
        assert_eq!((of(1.0).lightness, of(1.0).a, of(1.0).b), (100.0, 0.0, 0.0));
        assert!(of(0.0).lightness.abs() < 1e-13);
        // L* of a grey of 18.4187 % is 50.
        assert!((of(0.184_186_518_512_444_5).lightness - 50.0).abs() < 1e-9);
        let edge = (6.0f64 / 29.0).powi(3);
        assert!((of(edge * (1.0 + 1e-12)).lightness - of(edge * (1.0 - 1e-12)).lightness).abs() < 1e-9);
        assert_eq!(Lab::of(&white, &white.scaled(0.0)), None);
        assert!((of(1.0).distance(&of(0.0)) - 100.0).abs() < 1e-12);
    }
}

//! Receiver coordinates and exact small sums: the common ground of the closed forms.
//!
//! ```text
//! v_local = (t₁·v, t₂·v, n·v/|n|)      n·v and a·(b×c) in doubled precision
//! ```
//!
//! The sign of `n·v` decides what is above the horizon, and `a·(b×c)` how far a plane passes from the receiver; both may be
//! tiny against their terms, hence the error-free transformations (Dekker 1971; Ogita, Rump and Oishi 2005).

use crate::math::DVec3;

/// A sum of two doubles that do not overlap.
#[derive(Clone, Copy)]
struct Doubled {
    high: f64,
    low: f64,
}

/// `a + b` without rounding error.
fn exact_sum(a: f64, b: f64) -> Doubled {
    let high = a + b;
    let b_part = high - a;
    Doubled { high, low: (a - (high - b_part)) + (b - b_part) }
}

/// `a · b` without rounding error.
fn exact_product(a: f64, b: f64) -> Doubled {
    let high = a * b;
    Doubled { high, low: a.mul_add(b, -high) }
}

impl Doubled {
    fn plus(self, other: Doubled) -> Doubled {
        let sum = exact_sum(self.high, other.high);
        exact_sum(sum.high, sum.low + (self.low + other.low))
    }

    fn minus(self, other: Doubled) -> Doubled {
        self.plus(Doubled { high: -other.high, low: -other.low })
    }

    fn times(self, factor: f64) -> Doubled {
        let product = exact_product(self.high, factor);
        exact_sum(product.high, self.low.mul_add(factor, product.low))
    }
}

/// `a · b`, correctly rounded but for the last bits even where the terms cancel.
pub(super) fn dot(a: DVec3, b: DVec3) -> f64 {
    let sum = exact_product(a.x, b.x).plus(exact_product(a.y, b.y)).plus(exact_product(a.z, b.z));
    sum.high + sum.low
}

/// `a · (b × c)`, with an error far below one unit in the last place of the largest term.
pub(super) fn triple(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let minor = |p: f64, q: f64, r: f64, s: f64| exact_product(p, s).minus(exact_product(q, r));
    let sum = minor(b.y, b.z, c.y, c.z).times(a.x).plus(minor(b.z, b.x, c.z, c.x).times(a.y)).plus(minor(b.x, b.y, c.x, c.y).times(a.z));
    sum.high + sum.low
}

/// Power of two that brings `size` into [0.5, 1); `None` for zero and for what is not finite.
pub(super) fn power_of_two_scale(size: f64) -> Option<f64> {
    if !size.is_finite() || size <= 0.0 {
        return None;
    }
    // Exponent bits; a subnormal counts as the smallest normal number, which leaves it small but harmless.
    let exponent = ((size.to_bits() >> 52) & 0x7ff).max(1) as i64;
    let scale_exponent = (2045 - exponent).clamp(1, 2046) as u64;
    Some(f64::from_bits(scale_exponent << 52))
}

/// Unit vector along `v`; `None` for zero and for what is not finite.
pub(super) fn unit(v: DVec3) -> Option<DVec3> {
    if !v.is_finite() {
        return None;
    }
    let scaled = v * power_of_two_scale(v.abs().max_element())?;
    Some(scaled / scaled.length())
}

/// Coordinates in which the receiver's normal is +z.
pub(super) struct Frame {
    tangent: DVec3,
    bitangent: DVec3,
    /// The normal as given, scaled by a power of two: dividing by its length comes last, so the sign of `n·v` is exact.
    normal: DVec3,
    normal_length: f64,
}

impl Frame {
    /// Frame of a normal of any length; `None` for zero and for what is not finite. Branchless basis of Duff et al. 2017.
    pub(super) fn new(normal: DVec3) -> Option<Frame> {
        let n = unit(normal)?;
        let scaled = normal * power_of_two_scale(normal.abs().max_element())?;
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Some(Frame {
            tangent: DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            bitangent: DVec3::new(b, sign + n.y * n.y * a, -n.y),
            normal: scaled,
            normal_length: scaled.length(),
        })
    }

    /// Receiver coordinates of a vector.
    pub(super) fn to_local(&self, v: DVec3) -> DVec3 {
        DVec3::new(dot(self.tangent, v), dot(self.bitangent, v), dot(self.normal, v) / self.normal_length)
    }

    /// The same frame turned about the normal so that `v` has no second coordinate and a first one that is not negative.
    pub(super) fn turned_towards(self, v: DVec3) -> Frame {
        let local = self.to_local(v);
        let radius = local.x.hypot(local.y);
        if radius <= 0.0 {
            return self;
        }
        let (cos, sin) = (local.x / radius, local.y / radius);
        Frame { tangent: self.tangent * cos + self.bitangent * sin, bitangent: self.bitangent * cos - self.tangent * sin, ..self }
    }
}

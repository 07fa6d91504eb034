//! Products that neither overflow nor underflow on the way: `m · 2ᵉ` with `1 ≤ |m| < 2`.
//!
//! Scales of a spectrum (10⁻³⁰⁰ to 10³⁰⁰) are multiplied outside the integral in this form, and only the result becomes an `f64`.

/// `mantissa · 2^exponent`; the mantissa is 0, not finite, or in [1, 2) up to sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScaledNumber {
    mantissa: f64,
    exponent: i64,
}

impl ScaledNumber {
    /// `value` without loss.
    pub(super) fn new(value: f64) -> Self {
        if value == 0.0 || !value.is_finite() {
            return Self { mantissa: value, exponent: 0 };
        }
        // Subnormal numbers carry no implicit bit; 2^64 makes them normal, exactly.
        let (normal, shift) = if value.is_normal() { (value, 0) } else { (value * 2.0_f64.powi(64), -64) };
        let bits = normal.to_bits();
        let exponent = ((bits >> 52) & 0x7ff) as i64 - 1023;
        let mantissa = f64::from_bits((bits & !(0x7ff << 52)) | (1023 << 52));
        Self { mantissa, exponent: exponent + shift }
    }

    /// `exp(ln)`, also where `f64` cannot hold it. `ln` may be -infinity.
    pub(super) fn exp(ln: f64) -> Self {
        // Beyond this the remainder below has no digits left, and no product of this program brings the number back.
        const FURTHEST: f64 = 1e15;
        if ln.is_nan() || ln.abs() > FURTHEST {
            return Self::new(ln.exp());
        }
        let exponent = (ln / std::f64::consts::LN_2).round();
        let number = Self::new((ln - exponent * std::f64::consts::LN_2).exp());
        Self { mantissa: number.mantissa, exponent: number.exponent + exponent as i64 }
    }

    /// The product with `value`.
    pub(super) fn times(self, value: f64) -> Self {
        let other = Self::new(value);
        let product = Self::new(self.mantissa * other.mantissa);
        Self { mantissa: product.mantissa, exponent: self.exponent + other.exponent + product.exponent }
    }

    /// The product with another scaled number.
    pub(super) fn times_scaled(self, other: Self) -> Self {
        let product = self.times(other.mantissa);
        Self { mantissa: product.mantissa, exponent: product.exponent + other.exponent }
    }

    /// Whether it is zero.
    pub(super) fn is_zero(self) -> bool {
        self.mantissa == 0.0
    }

    /// The nearest `f64`: infinite or zero only if the product itself is out of range.
    pub(super) fn value(self) -> f64 {
        let step = |exponent: i64| 2.0_f64.powi(exponent.clamp(-1000, 1000) as i32);
        let first = step(self.exponent);
        let rest = self.exponent - self.exponent.clamp(-1000, 1000);
        self.mantissa * first * step(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extreme_factors_cancel_exactly() {
        let product = ScaledNumber::new(1e300).times(1e300).times(1e-300).times(1e-300);
        assert!((product.value() - 1.0).abs() < 1e-15);
        assert_eq!(ScaledNumber::new(5e-324).value(), 5e-324);
        assert_eq!(ScaledNumber::new(f64::MAX).value(), f64::MAX);
        assert_eq!(ScaledNumber::new(-0.1).value(), -0.1);
        assert_eq!(ScaledNumber::new(0.0).times(1e300).value(), 0.0);
        assert_eq!(ScaledNumber::new(1e300).times(1e300).value(), f64::INFINITY);
    }

    #[test]
    fn exponentials_out_of_range_come_back() {
        let product = ScaledNumber::exp(-5000.0).times_scaled(ScaledNumber::exp(5001.0));
        assert!((product.value() / std::f64::consts::E - 1.0).abs() < 2e-12);
        assert!(ScaledNumber::exp(f64::NEG_INFINITY).is_zero());
    }
}

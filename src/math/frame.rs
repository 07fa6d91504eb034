//! Orthonormal frames.

use super::DVec3;

/// Two unit vectors that complete `normal` (of unit length) to a right-handed frame (x, y, normal).
///
/// Duff et al., *Building an orthonormal basis, revisited*, JCGT 6 (2017): no branch, exact to rounding for every normal.
#[inline(always)]
#[must_use]
pub fn tangents(normal: DVec3) -> (DVec3, DVec3) {
    let sign = 1f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    (DVec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x), DVec3::new(b, sign + normal.y * normal.y * a, -normal.y))
}

/// A direction given in the frame (x, y, normal) of `normal`, in the world.
#[inline(always)]
#[must_use]
pub fn world_from_local(normal: DVec3, local: DVec3) -> DVec3 {
    let (x, y) = tangents(normal);
    x * local.x + y * local.y + normal * local.z
}

/// The unit vector of `v` whatever its length: |v| from 1e-300 to 1e300 neither under- nor overflows. None for zero or not finite.
#[must_use]
pub fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if !largest.is_finite() || largest == 0.0 {
        return None;
    }
    Some((v / largest).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_frame_is_orthonormal_and_right_handed(x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in -1.0..1.0_f64) {
            prop_assume!(x * x + y * y + z * z > 1e-6);
            let n = DVec3::new(x, y, z).normalize();
            let (t, b) = tangents(n);
            prop_assert!((t.cross(b) - n).length() < 1e-14);
            prop_assert!(t.dot(b).abs() < 1e-14 && (t.length() - 1.0).abs() < 1e-14);
        }

        #[test]
        fn a_unit_vector_does_not_depend_on_the_scale(exponent in -300..300_i32) {
            let v = DVec3::new(1.0, -2.0, 2.0);
            let u = unit(v * 10f64.powi(exponent)).unwrap();
            prop_assert!((u - v / 3.0).length() < 1e-15);
        }
    }
}

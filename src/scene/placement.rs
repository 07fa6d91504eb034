//! Where things are: `at`, `facing`, `up`, `turned_deg`.
//!
//! ```text
//! world = at + x local_x + y local_y + z local_z,   z = facing / |facing|,   x = up × z / |up × z|,   y = z × x
//! R = R_z R_y R_x for turned_deg: (rx, ry, rz), about the axes of the world, x first
//! ```
//!
//! | key | unit | default |
//! |---|---|---|
//! | `at` | m | (0, 0, 0) |
//! | `facing` | any length but zero | (0, 0, 1) |
//! | `up` | any length but zero | world z; world y if `facing` is within 1e-6 rad of ±z |
//! | `turned_deg` | degrees | (0, 0, 0) |

use super::decode::{Fields, normalised};
use super::diagnostic::Problems;
use crate::math::DVec3;

/// Angle between `facing` and `up` below which they count as parallel, rad.
const PARALLEL_RAD: f64 = 1e-9;
/// Angle between `facing` and the world's z axis below which y takes the place of z as the default of `up`, rad.
const UPRIGHT_RAD: f64 = 1e-6;

/// A right-handed frame at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    pub(super) at: DVec3,
    pub(super) x: DVec3,
    pub(super) y: DVec3,
    pub(super) z: DVec3,
}

impl Placement {
    /// A vector of the frame, in the world.
    pub(super) fn vector(&self, local: DVec3) -> DVec3 {
        self.x * local.x + self.y * local.y + self.z * local.z
    }

    /// A point of the frame, in the world.
    pub(super) fn point(&self, local: DVec3) -> DVec3 {
        self.at + self.vector(local)
    }
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
pub(super) fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    let turn = angle_deg.rem_euclid(360.0);
    let quarters = (turn / 90.0).round();
    let (s, c) = (turn - 90.0 * quarters).to_radians().sin_cos();
    match quarters as i64 % 4 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// The frame at a point that faces along the unit vector `z`; none if `up` is parallel to it.
pub(super) fn facing_frame(at: DVec3, z: DVec3, up: Option<DVec3>) -> Option<Placement> {
    let up = up.unwrap_or(if z.x.hypot(z.y) <= UPRIGHT_RAD { DVec3::Y } else { DVec3::Z });
    let across = up.cross(z);
    if across.length() <= PARALLEL_RAD {
        return None;
    }
    // Adding zero turns −0 into 0.
    let x = normalised(across)? + DVec3::ZERO;
    Some(Placement { at, x, y: z.cross(x) + DVec3::ZERO, z })
}

/// The frame at a point, turned about the axes of the world by angles in degrees.
pub(super) fn turned_frame(at: DVec3, turned_deg: DVec3) -> Placement {
    let [(sx, cx), (sy, cy), (sz, cz)] = [turned_deg.x, turned_deg.y, turned_deg.z].map(sin_cos_deg);
    let turn = |v: DVec3| {
        let v = DVec3::new(v.x, cx * v.y - sx * v.z, sx * v.y + cx * v.z);
        let v = DVec3::new(cy * v.x + sy * v.z, v.y, cy * v.z - sy * v.x);
        DVec3::new(cz * v.x - sz * v.y, sz * v.x + cz * v.y, v.z) + DVec3::ZERO
    };
    Placement { at, x: turn(DVec3::X), y: turn(DVec3::Y), z: turn(DVec3::Z) }
}

/// Reads `at` of something that can be placed.
pub(super) fn read_at(fields: &Fields, problems: &mut Problems) -> Option<DVec3> {
    match fields.get("at") {
        Some(at) => at.point_m(problems),
        None => Some(DVec3::ZERO),
    }
}

/// Reads `at` and `turned_deg`.
pub(super) fn read_turned(fields: &Fields, problems: &mut Problems) -> Option<Placement> {
    let turned_deg = match fields.get("turned_deg") {
        Some(turned) => turned.vector(problems),
        None => Some(DVec3::ZERO),
    };
    Some(turned_frame(read_at(fields, problems)?, turned_deg?))
}

/// Reads `facing` and `up` and makes the frame at a point.
pub(super) fn read_facing(fields: &Fields, at: DVec3, problems: &mut Problems) -> Option<Placement> {
    let z = match fields.get("facing") {
        Some(facing) => facing.direction(problems),
        None => Some(DVec3::Z),
    };
    let up = match fields.get("up") {
        Some(up) => Some(up.direction(problems)?),
        None => None,
    };
    let frame = facing_frame(at, z?, up);
    if frame.is_none()
        && let Some(up) = fields.get("up")
    {
        up.problem(
            problems,
            "`up` is parallel to `facing`, so it does not say which way the height points",
            "choose `up` across `facing`, or leave it out",
        );
    }
    frame
}

/// Reads the place of something flat: `at` with either `facing` and `up`, or `turned_deg`.
pub(super) fn read_flat(fields: &Fields, problems: &mut Problems) -> Option<Placement> {
    if fields.get("turned_deg").is_some() {
        fields.refuse(&["facing", "up"], "`turned_deg` says already which way it faces", problems);
        return read_turned(fields, problems);
    }
    let at = read_at(fields, problems);
    let frame = read_facing(fields, DVec3::ZERO, problems)?;
    Some(Placement { at: at?, ..frame })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn right_angles_are_exact() {
        for (deg, expected) in [(0.0, (0.0, 1.0)), (90.0, (1.0, 0.0)), (180.0, (0.0, -1.0)), (-90.0, (-1.0, 0.0)), (720.0, (0.0, 1.0))] {
            let (s, c) = sin_cos_deg(deg);
            assert_eq!((s + 0.0, c + 0.0), expected);
        }
        let frame = turned_frame(DVec3::ZERO, DVec3::new(90.0, 0.0, 90.0));
        // x → x → y; y → z → z; z → −y → x.
        assert_eq!((frame.x, frame.y, frame.z), (DVec3::Y, DVec3::Z, DVec3::X));
    }

    #[test]
    fn the_default_height_of_a_wall_points_up() {
        let wall = facing_frame(DVec3::ZERO, DVec3::X, None).map(|f| (f.x, f.y));
        assert_eq!(wall, Some((DVec3::Y, DVec3::Z)));
        let floor = facing_frame(DVec3::ZERO, DVec3::Z, None).map(|f| (f.x, f.y));
        assert_eq!(floor, Some((DVec3::X, DVec3::Y)));
        assert_eq!(facing_frame(DVec3::ZERO, DVec3::Z, Some(-DVec3::Z)), None);
    }

    proptest! {
        #[test]
        fn frames_are_right_handed_and_orthonormal(a in -400.0..400.0_f64, b in -400.0..400.0_f64, c in -400.0..400.0_f64) {
            let turned = turned_frame(DVec3::ZERO, DVec3::new(a, b, c));
            let facing = normalised(DVec3::new(a, b, c)).and_then(|z| facing_frame(DVec3::ZERO, z, None));
            for frame in [Some(turned), facing].into_iter().flatten() {
                prop_assert!((frame.x.cross(frame.y) - frame.z).length() < 1e-14);
                prop_assert!((frame.x.length() - 1.0).abs() < 1e-14 && (frame.y.length() - 1.0).abs() < 1e-14);
            }
        }
    }
}

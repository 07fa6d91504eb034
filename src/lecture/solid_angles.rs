//! Solid angles and projected solid angles.

use super::equation::Domain::{Between, NotNegative, Positive, Real};
use super::equation::{Equation, Group, Input, Outcome, input, outcome};
use crate::estimate::closed_form::{cone, polygon};
use crate::math::DVec3;
use crate::quantity::{Area, Distance, ProjectedSolidAngle, SolidAngle};

const SOLID_ANGLE: Outcome = outcome("solid angle", "Ω", "sr");
const PROJECTED: Outcome = outcome("projected solid angle", "Ω_p", "sr");
const DISTANCE: Input = input("distance_m", "d", "m", Positive, "distance of the plane from the viewer");
const RADIUS: Input = input("radius_m", "R", "m", NotNegative, "radius");
const HALF_ANGLE: Input = input("half_angle_deg", "α", "°", Between(0.0, 180.0), "half angle of the cone");
const NARROW_HALF_ANGLE: Input = input("half_angle_deg", "α", "°", Between(0.0, 90.0), "half angle of the cone");
const RECTANGLE: [Input; 5] = [
    input("x_from_m", "x₀", "m", Real, "where it begins, from the foot of the perpendicular"),
    input("x_to_m", "x₁", "m", Real, "where it ends"),
    input("y_from_m", "y₀", "m", Real, "where it begins, from the foot of the perpendicular"),
    input("y_to_m", "y₁", "m", Real, "where it ends"),
    DISTANCE,
];
const CORNERS: [Input; 9] = [
    input("ax", "a_x", "1", Real, "first corner, relative to the viewer"),
    input("ay", "a_y", "1", Real, "first corner"),
    input("az", "a_z", "1", Real, "first corner"),
    input("bx", "b_x", "1", Real, "second corner, in the same unit of length"),
    input("by", "b_y", "1", Real, "second corner"),
    input("bz", "b_z", "1", Real, "second corner"),
    input("cx", "c_x", "1", Real, "third corner, in the same unit of length"),
    input("cy", "c_y", "1", Real, "third corner"),
    input("cz", "c_z", "1", Real, "third corner"),
];
const DIN: &str = "DIN 5031-1";
const NO_TRIANGLE: &str = "a corner of the triangle is at the viewer, so it has no direction";

fn corners(g: &super::Given) -> [[f64; 3]; 3] {
    [["ax", "ay", "az"], ["bx", "by", "bz"], ["cx", "cy", "cz"]].map(|corner| corner.map(|key| g.number(key)))
}

fn vector([x, y, z]: [f64; 3]) -> DVec3 {
    DVec3::new(x, y, z)
}

pub(super) const EQUATIONS: &[Equation] = &[
    Equation {
        name: "solid-angle",
        group: Group::SolidAngles,
        formula: "Ω = A / r²",
        about: "patch of a sphere about the viewer, or a small area that faces the viewer",
        inputs: &[
            input("area_m2", "A", "m²", NotNegative, "area of the patch"),
            input("distance_m", "r", "m", Positive, "distance from the viewer"),
        ],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[("area_m2", "0.02"), ("distance_m", "2")],
        compute: |g| Ok(SolidAngle::patch(Area::new(g.number("area_m2")), Distance::new(g.number("distance_m"))).value()),
        also: &[],
    },
    Equation {
        name: "sphere",
        group: Group::SolidAngles,
        formula: "Ω = ∫ dω = 4π",
        about: "all directions",
        inputs: &[],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[],
        compute: |_| Ok(SolidAngle::SPHERE.value()),
        also: &[],
    },
    Equation {
        name: "hemisphere",
        group: Group::SolidAngles,
        formula: "Ω = ∫ dω = 2π",
        about: "half of all directions",
        inputs: &[],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[],
        compute: |_| Ok(SolidAngle::HEMISPHERE.value()),
        also: &[],
    },
    Equation {
        name: "cone",
        group: Group::SolidAngles,
        formula: "Ω = 4π sin²(α/2)",
        about: "circular cone",
        inputs: &[HALF_ANGLE],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[("half_angle_deg", "0.5")],
        compute: |g| Ok(SolidAngle::cone(g.number("half_angle_deg").to_radians()).value()),
        also: &[],
    },
    Equation {
        name: "disc",
        group: Group::SolidAngles,
        formula: "Ω = 4π sin²(½ atan(R/d))",
        about: "disc that is seen from its axis",
        inputs: &[RADIUS, DISTANCE],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[("radius_m", "0.1"), ("distance_m", "1")],
        compute: |g| Ok(SolidAngle::disc(Distance::new(g.number("radius_m")), Distance::new(g.number("distance_m"))).value()),
        also: &[],
    },
    Equation {
        name: "rectangle",
        group: Group::SolidAngles,
        formula: "Ω = Σ ± atan(x y / (d √(x² + y² + d²)))",
        about: "plane rectangle as a rectangle on the sphere of directions; the sum runs over its corners",
        inputs: &RECTANGLE,
        outcome: SOLID_ANGLE,
        source: "A. Van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125",
        example: &[("x_from_m", "-1"), ("x_to_m", "1"), ("y_from_m", "-1"), ("y_to_m", "1"), ("distance_m", "1")],
        compute: |g| {
            let [x0, x1, y0, y1, d] = ["x_from_m", "x_to_m", "y_from_m", "y_to_m", "distance_m"].map(|key| g.number(key));
            let seen = SolidAngle::rectangle([x0, x1], [y0, y1], Distance::new(d));
            seen.map(SolidAngle::value).ok_or_else(|| "the rectangle is at no finite place before the viewer".into())
        },
        also: &[],
    },
    Equation {
        name: "polar-rectangle",
        group: Group::SolidAngles,
        formula: "Ω = Δφ (cos θ₀ − cos θ₁)",
        about: "rectangle in polar angles",
        inputs: &[
            input("theta_from_deg", "θ₀", "°", Between(0.0, 180.0), "polar angle where it begins"),
            input("theta_to_deg", "θ₁", "°", Between(0.0, 180.0), "polar angle where it ends"),
            input("azimuth_deg", "Δφ", "°", Between(0.0, 360.0), "its width in azimuth"),
        ],
        outcome: SOLID_ANGLE,
        source: DIN,
        example: &[("theta_from_deg", "0"), ("theta_to_deg", "90"), ("azimuth_deg", "90")],
        compute: |g| {
            let [from, to, azimuth] = ["theta_from_deg", "theta_to_deg", "azimuth_deg"].map(|key| g.number(key).to_radians());
            Ok(SolidAngle::polar_rectangle(from, to, azimuth).value())
        },
        also: &[],
    },
    Equation {
        name: "spherical-triangle",
        group: Group::SolidAngles,
        formula: "tan(Ω/2) = |a·(b×c)| / (abc + (a·b)c + (b·c)a + (c·a)b)",
        about: "triangle of three directions, or plane triangle with corners relative to the viewer",
        inputs: &CORNERS,
        outcome: SOLID_ANGLE,
        source: "A. Van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125",
        example: &[("ax", "1"), ("ay", "0"), ("az", "0"), ("bx", "0"), ("by", "1"), ("bz", "0"), ("cx", "0"), ("cy", "0"), ("cz", "1")],
        compute: |g| {
            let [a, b, c] = corners(g);
            SolidAngle::triangle(a, b, c).map(SolidAngle::value).ok_or_else(|| NO_TRIANGLE.into())
        },
        also: &[],
    },
    Equation {
        name: "projected-hemisphere",
        group: Group::SolidAngles,
        formula: "Ω_p = ∫ cos θ dω = π",
        about: "half of all directions, weighted with the cosine",
        inputs: &[],
        outcome: PROJECTED,
        source: DIN,
        example: &[],
        compute: |_| Ok(ProjectedSolidAngle::HEMISPHERE.value()),
        also: &[],
    },
    Equation {
        name: "projected-cone",
        group: Group::SolidAngles,
        formula: "Ω_p = π sin²α",
        about: "cone about the normal, weighted with the cosine",
        inputs: &[NARROW_HALF_ANGLE],
        outcome: PROJECTED,
        source: DIN,
        example: &[("half_angle_deg", "30")],
        compute: |g| Ok(ProjectedSolidAngle::cone(g.number("half_angle_deg").to_radians()).value()),
        also: &[],
    },
    Equation {
        name: "projected-tilted-cone",
        group: Group::SolidAngles,
        formula: "Ω_p = π sin²α cos τ   (more than that where the horizon cuts the cone)",
        about: "cone whose axis is tilted from the normal; what is below the horizon does not count",
        inputs: &[NARROW_HALF_ANGLE, input("tilt_deg", "τ", "°", Between(0.0, 180.0), "angle between its axis and the normal")],
        outcome: PROJECTED,
        source: "J. R. Howell, A Catalog of Radiation Heat Transfer Configuration Factors: element to sphere",
        example: &[("half_angle_deg", "30"), ("tilt_deg", "45")],
        compute: |g| Ok(cone::tilted_projected_solid_angle(g.number("half_angle_deg").to_radians(), g.number("tilt_deg").to_radians())),
        also: &[],
    },
    Equation {
        name: "projected-rectangle",
        group: Group::SolidAngles,
        formula: "Ω_p = ½ |Σ θᵢ γᵢ·n|",
        about: "plane rectangle parallel to the receiver, weighted with the cosine; the sum runs over its edges",
        inputs: &RECTANGLE,
        outcome: PROJECTED,
        source: "J. H. Lambert, Photometria (1760), theorem 16",
        example: &[("x_from_m", "0"), ("x_to_m", "1"), ("y_from_m", "0"), ("y_to_m", "1"), ("distance_m", "1")],
        compute: |g| {
            let [x0, x1, y0, y1, d] = ["x_from_m", "x_to_m", "y_from_m", "y_to_m", "distance_m"].map(|key| g.number(key));
            let corners = [[x0, y0, d], [x1, y0, d], [x1, y1, d], [x0, y1, d]].map(vector);
            Ok(polygon::polygon_two_sided(&corners, DVec3::Z))
        },
        also: &[],
    },
    Equation {
        name: "projected-triangle",
        group: Group::SolidAngles,
        formula: "Ω_p = ½ |Σ θᵢ γᵢ·n|",
        about: "plane triangle with corners relative to a receiver whose normal is z; what is below its horizon does not count",
        inputs: &CORNERS,
        outcome: PROJECTED,
        source: "J. H. Lambert, Photometria (1760), theorem 16",
        example: &[("ax", "1"), ("ay", "0"), ("az", "0"), ("bx", "0"), ("by", "1"), ("bz", "0"), ("cx", "0"), ("cy", "0"), ("cz", "1")],
        compute: |g| {
            let [a, b, c] = corners(g);
            SolidAngle::triangle(a, b, c).ok_or(NO_TRIANGLE)?;
            Ok(polygon::polygon_two_sided(&[a, b, c].map(vector), DVec3::Z))
        },
        also: &[],
    },
];

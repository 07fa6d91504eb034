//! Polygons keep their area when they are cut into triangles, and say what is wrong with their corners.

use super::*;
use proptest::prelude::*;

/// A polygon with corners around the origin at increasing azimuths: simple whatever the radii are.
fn star(radii: &[f64], normal: DVec3, centre: DVec3) -> Vec<DVec3> {
    let (x, y) = tangents(normal.normalize());
    let step = std::f64::consts::TAU / radii.len() as f64;
    radii.iter().enumerate().map(|(i, r)| centre + (x * (i as f64 * step).cos() + y * (i as f64 * step).sin()) * *r).collect()
}

proptest! {
    #[test]
    fn triangles_make_up_the_polygon_and_keep_its_sense(
        radii in prop::collection::vec(0.05..1.0_f64, 3..20), n in prop::array::uniform3(-1.0..1.0_f64), scale in -12..12_i32,
    ) {
        prop_assume!(DVec3::from_array(n).length() > 0.1);
        let scale = 10f64.powi(scale);
        let corners: Vec<DVec3> = star(&radii, DVec3::from_array(n), DVec3::new(1.0, 2.0, 3.0)).iter().map(|&c| c * scale).collect();
        let polygon = Polygon::new(&corners).unwrap();
        prop_assert!(polygon.normal().dot(DVec3::from_array(n).normalize()) > 1.0 - 1e-12);
        let mut area = 0.0;
        for [a, b, c] in polygon.triangles() {
            let vector = 0.5 * (b - a).cross(c - a);
            prop_assert!(vector.dot(polygon.normal()) >= -1e-12 * polygon.area_m2());
            area += vector.length();
        }
        prop_assert!((area / polygon.area_m2() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn samples_are_on_the_polygon_and_have_its_centroid(radii in prop::collection::vec(0.2..1.0_f64, 3..9)) {
        let polygon = Polygon::new(&star(&radii, DVec3::new(0.3, -0.2, 1.0), DVec3::ZERO)).unwrap();
        let centroid = polygon.triangles().map(|[a, b, c]| (a + b + c) / 3.0 * (0.5 * (b - a).cross(c - a).length())).sum::<DVec3>() / polygon.area_m2();
        let n = 256;
        let mut mean = DVec3::ZERO;
        for i in 0..n * n {
            let u = [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
            let point = polygon.corners()[0] + polygon.sample_by_area(u);
            prop_assert!((polygon.nearest_point(point) - point).length() < 1e-12);
            mean += point / f64::from(n * n);
        }
        prop_assert!((mean - centroid).length() < 0.02, "{mean} {centroid}");
        prop_assert!((polygon.pdf_by_area() * polygon.area_m2() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn corners_that_make_no_polygon_are_told_apart() {
    let v = DVec3::new;
    let (o, x, y) = (DVec3::ZERO, DVec3::X, DVec3::Y);
    assert_eq!(Polygon::new(&[o, x]), Err(PolygonError::CornerCount(2)));
    assert_eq!(Polygon::new(&[o, x, v(0.0, f64::NAN, 0.0)]), Err(PolygonError::NotFinite(2)));
    assert_eq!(Polygon::new(&[x, x, x]), Err(PolygonError::NoArea));
    assert_eq!(Polygon::new(&[v(0.1, 0.1, 0.7), v(0.2, 0.2, 0.7), v(0.3, 0.3, 0.7)]), Err(PolygonError::NoArea));
    assert!(matches!(Polygon::new(&[o, x, x + y, y + v(0.0, 0.0, 1e-3)]), Err(PolygonError::NotPlane { .. })));
    assert!(matches!(Polygon::new(&[o, x, y, x + y]), Err(PolygonError::EdgesMeet(..))));
    assert!(matches!(Polygon::new(&[o, x, y, x + y + y]), Err(PolygonError::EdgesMeet(..))));
    assert!(matches!(Polygon::new(&[o, x, x, x + y, y]), Err(PolygonError::EdgesMeet(1, 2))));
    assert!(matches!(Polygon::new(&[o, x * 2.0, x, x + y]), Err(PolygonError::EdgesMeet(0, 1))));
    // A corner in the middle of an edge is fine.
    assert_eq!(Polygon::new(&[o, 0.5 * x, x, x + y, y]).map(|p| p.area_m2()), Ok(1.0));
}

#[test]
fn a_sliver_is_a_polygon() {
    let sliver = Polygon::new(&[DVec3::new(-1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 2e-12, 1.0)]).unwrap();
    assert_eq!((sliver.normal(), sliver.area_m2()), (DVec3::Z, 2e-12));
}

#[test]
fn the_notch_of_a_polygon_is_outside() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]].map(|[x, y]| DVec3::new(x, y, 5.0));
    let polygon = Polygon::new(&corners).unwrap();
    assert_eq!(polygon.area_m2(), 3.0);
    assert_eq!(polygon.nearest_point(DVec3::new(0.5, 0.5, 9.0)), DVec3::new(0.5, 0.5, 5.0));
    assert!(
        (polygon.nearest_point(DVec3::new(1.0, 2.0, 5.0)) - DVec3::new(0.5, 1.5, 5.0)).length() < 1e-15
            || (polygon.nearest_point(DVec3::new(1.0, 2.0, 5.0)) - DVec3::new(1.5, 1.5, 5.0)).length() < 1e-15
    );
    assert_eq!(polygon.bounding_sphere().0, DVec3::new(1.0, 1.0, 5.0));
}

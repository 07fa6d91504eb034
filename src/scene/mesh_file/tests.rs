//! Files of meshes, whole and broken.

use super::*;
use proptest::prelude::*;

const OBJ: &str = "# a square and a triangle\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\n\
    f 1/1/1 2//1 3/1 4\nusemtl x\nv 0 0 1.5e0\r\nf -1 -2 \\\n -3\n";

fn square_ply(format: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nelement vertex 4\nproperty uchar red\nproperty float x\nproperty double y\nproperty float z\n\
         property list uchar short tags\nelement face 2\nproperty list uchar int vertex_indices\nproperty float quality\nelement edge 1\nproperty int a\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.5]];
    let faces: [&[i32]; 2] = [&[0, 1, 2, 3], &[2, 1, 0]];
    if format == "ascii" {
        corners.iter().for_each(|[x, y]| bytes.extend(format!("255 {x} {y} 0.25 2 -7 8\n").bytes()));
        bytes.extend(b"4 0 1 2 3 0.5\n\n3 2 1 0 0.5\n7");
        return bytes;
    }
    let big = format == "binary_big_endian";
    let mut put = |little: &[u8]| {
        if big { bytes.extend(little.iter().rev()) } else { bytes.extend(little) }
    };
    for [x, y] in corners {
        put(&[255]);
        put(&(x as f32).to_le_bytes());
        put(&f64::to_le_bytes(y));
        put(&0.25_f32.to_le_bytes());
        put(&[2]);
        put(&(-7_i16).to_le_bytes());
        put(&8_i16.to_le_bytes());
    }
    for face in faces {
        put(&[face.len() as u8]);
        face.iter().for_each(|index| put(&index.to_le_bytes()));
        put(&0.5_f32.to_le_bytes());
    }
    put(&7_i32.to_le_bytes());
    bytes
}

fn first(result: Result<MeshData, MeshProblems>) -> (usize, usize, Option<usize>, String) {
    let problem = result.unwrap_err().problems.swap_remove(0);
    (problem.line, problem.column, problem.byte_offset, problem.message)
}

#[test]
fn an_obj_file_gives_its_points_and_fans_of_triangles() {
    let mesh = parse_obj(OBJ.as_bytes()).unwrap();
    assert_eq!(mesh.points.len(), 5);
    assert_eq!(mesh.points[4], DVec3::new(0.0, 0.0, 1.5));
    assert_eq!(mesh.triangles, vec![[0, 1, 2], [0, 2, 3], [4, 3, 2]]);
}

#[test]
fn the_three_formats_of_ply_say_the_same() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let mesh = parse_ply(&square_ply(format)).unwrap();
        assert_eq!(
            mesh.points,
            vec![DVec3::new(0.0, 0.0, 0.25), DVec3::new(1.0, 0.0, 0.25), DVec3::new(1.0, 1.0, 0.25), DVec3::new(0.0, 1.5, 0.25)],
            "{format}"
        );
        assert_eq!(mesh.triangles, vec![[0, 1, 2], [0, 2, 3], [2, 1, 0]], "{format}");
    }
}

#[test]
fn every_problem_of_an_obj_file_is_reported_with_its_place() {
    let text = "v 0 0\nv 0 x 0\nv 0 0 nan\nf 1 2 9\nf 1/a 2 3\nf -9 1 2\nf 1 2\nf 0 1 2\nwhat 3\nsurf 0 1\n";
    let problems = parse_obj(text.as_bytes()).unwrap_err();
    let places: Vec<(usize, usize)> = problems.problems.iter().map(|p| (p.line, p.column)).collect();
    assert_eq!(places, [(1, 1), (2, 5), (3, 7), (5, 3), (6, 3), (7, 1), (8, 3), (9, 1), (10, 1), (4, 7)], "{problems}");
    assert!(problems.problems.iter().all(|p| !p.help.is_empty()));
    let many = "v a b c\n".repeat(50);
    let problems = parse_obj(many.as_bytes()).unwrap_err();
    assert_eq!((problems.problems.len(), problems.more), (PROBLEM_LIMIT, 150 - PROBLEM_LIMIT));
    assert!(problems.to_string().ends_with("and 130 more\n"));
}

#[test]
fn a_file_without_faces_is_a_problem() {
    assert!(first(parse_obj(b"v 0 0 0\n")).3.contains("no faces"));
    assert!(first(parse_obj(b"")).3.contains("no faces"));
    let cloud = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
    assert!(first(parse_ply(cloud.as_bytes())).3.contains("no element \"face\""));
}

#[test]
fn a_ply_header_that_claims_too_much_takes_no_memory() {
    for count in ["49000000", "50000001", "99999999999999999999999", "-1"] {
        for format in ["ascii", "binary_little_endian"] {
            let text = format!(
                "ply\nformat {format} 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
            );
            assert_eq!(first(parse_ply(text.as_bytes())).0, 3, "{count}");
        }
    }
    // A list that is longer than the file.
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_index\nend_header\n".to_vec();
    let start = bytes.len();
    bytes.extend(u32::MAX.to_le_bytes());
    let (_, _, byte, message) = first(parse_ply(&bytes));
    assert!(message.contains("does not fit"), "{message}");
    assert_eq!(byte, Some(start));
}

#[test]
fn problems_of_a_ply_body_name_line_and_column_or_byte() {
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n";
    let text = format!("{head}0 0 0\n1 0 zero\n0 1 0 5\n3 0 1 2\n3 0 1 3\n2 0 1\n");
    let problems = parse_ply(text.as_bytes()).unwrap_err();
    let places: Vec<(usize, usize)> = problems.problems.iter().map(|p| (p.line, p.column)).collect();
    assert_eq!(places, [(11, 5), (12, 5), (14, 7), (15, 5)], "{problems}");
    let whole = square_ply("binary_little_endian");
    let (.., byte, message) = first(parse_ply(&whole[..whole.len() - 2]));
    assert!(message.contains("ends here") && byte.is_some(), "{message}");
}

#[test]
fn problems_of_a_ply_header_are_reported_together() {
    let text = "ply\nformat ascii 1.0\nproperty float early\nelement vertex 3\nproperty flaot x\nproperty float y\nnonsense\nelement face 1\nproperty list float float vertex_indices\nend_header\n";
    let problems = parse_ply(text.as_bytes()).unwrap_err();
    let lines: Vec<usize> = problems.problems.iter().map(|p| p.line).collect();
    assert!([3, 5, 7, 9, 4, 8].iter().all(|line| lines.contains(line)), "{problems}");
    assert_eq!(first(parse_ply(b"plz\n")).0, 1);
    assert!(first(parse_ply(b"ply\nformat ascii 1.0\n")).3.contains("does not end"));
    assert!(first(parse_ply(b"ply\nformat ascii 2.0\nend_header\n")).0 == 2);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_damaged_file_is_read_or_refused_but_makes_no_panic(
        which in 0..4_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), prop_oneof![any::<u8>(), prop::sample::select(b"0123456789-/ \n".to_vec())]), 0..8),
        cut in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        let mut bytes = match which {
            0 => OBJ.as_bytes().to_vec(),
            1 => square_ply("ascii"),
            2 => square_ply("binary_little_endian"),
            _ => square_ply("binary_big_endian"),
        };
        for (place, value) in changes {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        if is_cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        for result in [parse_obj(&bytes), parse_ply(&bytes)] {
            match result {
                Ok(mesh) => {
                    prop_assert!(mesh.points.iter().all(|p| p.is_finite()));
                    prop_assert!(mesh.triangles.iter().flatten().all(|&index| (index as usize) < mesh.points.len()));
                }
                Err(problems) => prop_assert!(!problems.problems.is_empty() && problems.problems.len() <= PROBLEM_LIMIT),
            }
        }
    }
}

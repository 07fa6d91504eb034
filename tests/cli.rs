//! The command line as a user meets it: what is on stdout, what is on stderr, and the exit code.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::process::{Command, Output};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn etendue(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue")).args(arguments).current_dir(root()).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A folder of its own for files that a test writes.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_good_scene_is_ok() {
    let output = etendue(&["check", "scenes/photometric-bench.ron"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("ok: 1 source"));
    assert!(stderr(&output).is_empty());
}

#[test]
fn a_reading_has_value_unit_uncertainty_and_coverage_factor() {
    let output = etendue(&["measure", "scenes/photometric-bench.ron"]);
    assert_eq!(output.status.code(), Some(0));
    let text = stdout(&output);
    let row = text.lines().find(|l| l.contains("meter [1]")).unwrap();
    for part in ["illuminance", " 250 ", "lx", "±", "1.96"] {
        assert!(row.contains(part), "no `{part}` in {row}");
    }
    assert!(text.contains("0 samples, 0 rays, 0 BVH nodes"), "{text}");
}

#[test]
fn the_scene_of_the_readme_reads_what_it_says() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let scene = readme.split("```ron\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let folder = scratch("readme");
    for part in ["scenes", "sensors"] {
        std::fs::create_dir_all(folder.join(part)).unwrap();
    }
    let path = folder.join("scenes/first.ron");
    std::fs::write(&path, scene).unwrap();
    let sensor = "sensors/ideal-illuminance-meter.ron";
    std::fs::copy(root().join(sensor), folder.join(sensor)).unwrap();
    let output = etendue(&["measure", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(readme.contains("It reads 25 lx"));
    assert!(stdout(&output).contains(" 25  lx "), "{}", stdout(&output));
}

#[test]
fn the_table_says_what_its_columns_mean() {
    let text = stdout(&etendue(&["measure", "scenes/photometric-bench.ron"]));
    for part in ["U = k u_c at 95 %; exact: U below 1e-9 of the reading", "budgets of these 5 readings: --format json"] {
        assert_eq!(text.matches(part).count(), 1, "`{part}` in\n{text}");
    }
}

#[test]
fn the_map_of_a_grid_says_where_its_axes_point() {
    let folder = scratch("grid");
    let path = folder.join("grid.ron");
    let scene = "Scene(
        sources: [(name: \"lamp\", shape: Point, at: (0, 0, 2), strength: Candela(100), spectrum: \"A\")],
        instruments: [(name: \"wall\", grid: (from: (-1, 0, 0), to: (1, 0, 1), points: (3, 2)), facing: (0, 0, 1),
            sensor: Sensor(title: \"ideal\", aperture: Point, acceptance: Cosine,
                           channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))],
    )";
    std::fs::write(&path, scene).unwrap();
    let output = etendue(&["measure", path.to_str().unwrap()]);
    let text = stdout(&output);
    assert!(text.contains("(x to the right, z upwards)"), "{text}{}", stderr(&output));
    // The lowest of the points is at a corner below, 100 cd · 2/√5³ / 1 m²; the highest above, 100 lx.
    assert!(text.contains("0.179 lowest/highest   (± U)"), "{text}");
}

#[test]
fn bad_input_is_told_on_stderr_with_exit_code_two_and_nothing_is_written() {
    let folder = scratch("bad-input");
    let scene = folder.join("broken.ron");
    std::fs::write(&scene, "Scene(\n    sources: [(name: \"lamp\", shape: Pont, strength: Candela(-1), spectrum: \"A\")],\n)\n").unwrap();
    let out = folder.join("out");
    let path = scene.to_str().unwrap();
    for arguments in [vec!["check", path], vec!["explain", path], vec!["measure", path, "--out", out.to_str().unwrap()]] {
        let output = etendue(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        let message = stderr(&output);
        for part in ["broken.ron:2:", "`Pont`", "did you mean `Point`?", "instruments"] {
            assert!(message.contains(part), "no `{part}` in\n{message}");
        }
    }
    assert!(!out.exists());
}

#[test]
fn bad_arguments_are_told_with_exit_code_two() {
    let scene = "scenes/photometric-bench.ron";
    for (arguments, part) in [
        (vec!["measure"], "SCENE"),
        (vec!["measure", scene, "--target", "-1%"], "a positive share such as 0.1%"),
        (vec!["measure", scene, "--target", "5"], "5 means 500 %; write 5%"),
        (vec!["measure", scene, "--target", "1"], "1 means 100 %; write 1%"),
        (vec!["measure", scene, "--budget", "2"], "a positive time with its unit"),
        (vec!["measure", scene, "--samples", "0"], "0"),
        (vec!["measure", scene, "--samples", "10", "--target", "1%"], "cannot be used with"),
        (vec!["measure", scene, "--seed", "-1"], "0 to 18446744073709551615"),
        (vec!["measure", scene, "--seed", "18446744073709551616"], "0 to 18446744073709551615"),
        (vec!["measure", scene, "--samples", "-1"], "1 to 4294967296"),
        (vec!["measure", scene, "--threads", "-1"], "1 to 1024"),
        (vec!["measure", scene, "--format", "xml"], "json"),
        (vec!["measur", scene], "measure"),
        (vec!["explain", scene, "--without", "nothing_block"], "nothing_blocks"),
        (vec!["check", "scenes/photometric-bank.ron"], "photometric-bench.ron"),
    ] {
        let output = etendue(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(part), "{arguments:?}: no `{part}` in\n{}", stderr(&output));
    }
}

#[test]
fn light_that_is_never_absorbed_fails_with_exit_code_one() {
    let folder = scratch("endless");
    let scene = folder.join("perfect.ron");
    let walls = [
        ("a", "(0, 0, 0)", "(1, 0, 0)", "(0, 1, 0)"),
        ("b", "(0, 0, 1)", "(1, 0, 0)", "(0, 1, 0)"),
        ("c", "(0, 0, 0)", "(1, 0, 0)", "(0, 0, 1)"),
        ("d", "(0, 1, 0)", "(1, 0, 0)", "(0, 0, 1)"),
        ("e", "(0, 0, 0)", "(0, 1, 0)", "(0, 0, 1)"),
        ("f", "(1, 0, 0)", "(0, 1, 0)", "(0, 0, 1)"),
    ]
    .map(|(name, c, u, v)| format!("(name: \"{name}\", shape: Quad(corner: {c}, u: {u}, v: {v}), surface: \"white\")"))
    .join(", ");
    let text = format!(
        "Scene(surfaces: {{ \"white\": Lambertian(1.0) }}, objects: [{walls}], \
         sources: [(name: \"lamp\", shape: Point, at: (0.5, 0.5, 0.5), strength: Candela(1), spectrum: \"A\")], \
         instruments: [(name: \"m\", at: (0.2, 0.2, 0.2), facing: (0, 0, 1), sensor: Sensor(title: \"i\", aperture: Point, \
         acceptance: Cosine, channels: [(name: \"E\", responsivity: \"V\", reads: Illuminance)]))])"
    );
    std::fs::write(&scene, text).unwrap();
    let output = etendue(&["measure", scene.to_str().unwrap()]);
    assert!(matches!(output.status.code(), Some(1 | 2)), "{:?}", output.status);
    assert!(output.stdout.is_empty());
    assert!(stderr(&output).contains("reflectance"), "{}", stderr(&output));
}

#[test]
fn files_are_written_whole_and_say_where() {
    let folder = scratch("out");
    for (format, extension, part) in
        [("json", "json", "\"expanded_uncertainty\""), ("csv", "csv", "expanded_uncertainty"), ("text", "txt", "±")]
    {
        let output = etendue(&["measure", "scenes/photometric-bench.ron", "--format", format, "--out", folder.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let path = folder.join("photometric-bench").with_extension(extension);
        assert_eq!(stdout(&output).trim(), path.to_str().unwrap());
        let written = std::fs::read_to_string(path).unwrap();
        assert!(written.contains(part));
        match format {
            "json" => assert!(written.contains("\"coverage_probability\": 0.95")),
            "csv" => assert!(
                written.starts_with("instrument,") && written.lines().next().unwrap().contains(",target_met,seed,notes,ideal_value,")
            ),
            _ => {}
        }
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 3, "nothing half-written is left behind");
}

#[test]
fn the_json_is_the_same_for_any_number_of_threads() {
    let of = |threads: &str| {
        let output = etendue(&["measure", "scenes/cornell-box.ron", "--format", "json", "--seed", "5", "--threads", threads]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output).lines().filter(|l| !l.contains("seconds\"")).map(|l| format!("{l}\n")).collect::<String>()
    };
    let one = of("1");
    assert!(one.contains("\"samples\"") && one.contains("\"schema\": 1"));
    assert_eq!(one, of("2"));
    assert_eq!(one, of("8"));
}

/// A scene of one lamp with the given spectrum and one meter.
fn lamp_scene(spectrum: &str) -> String {
    format!(
        "Scene(
        sources: [(name: \"lamp\", shape: Point, at: (0, 0, 2), strength: Candela(100), spectrum: \"{spectrum}\")],
        instruments: [(name: \"meter\", at: (0, 0, 0), facing: (0, 0, 1),
            sensor: Sensor(title: \"ideal\", aperture: Point, acceptance: Cosine,
                           channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))],
    )"
    )
}

#[test]
fn decimal_commas_are_accepted_and_told_whatever_separates_the_columns() {
    let folder = scratch("decimal-comma");
    let scene = folder.join("scene.ron");
    std::fs::write(&scene, lamp_scene("lamp.csv")).unwrap();
    for rows in ["400;1,5\n500;2,5\n", "nm;value\n400;1,5\n500;2,5\n", "nm;value\n400,5;1,5\n500,5;2,5\n", "400,5 1,5\n500,5 2,5\n"] {
        std::fs::write(folder.join("lamp.csv"), rows).unwrap();
        let output = etendue(&["check", scene.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(0), "{rows}{}", stderr(&output));
        assert!(stderr(&output).contains("decimal comma"), "{rows}{}", stderr(&output));
    }
    // What may be thousands or a fraction is not guessed, and what separates the columns is not changed on the way.
    for (rows, help) in [("400;1,500\n500;2,500\n", "# decimal: comma"), ("nm,value\n400;1,5\n500;2,5\n", "separate all columns alike")] {
        std::fs::write(folder.join("lamp.csv"), rows).unwrap();
        let output = etendue(&["check", scene.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{rows}");
        assert!(stderr(&output).contains(help), "{rows}{}", stderr(&output));
    }
}

#[test]
fn a_dot_in_the_name_of_a_scene_stays_in_the_name_of_its_readings() {
    let folder = scratch("dots");
    let out = folder.join("out");
    for name in ["a.b.ron", "a.c.ron"] {
        std::fs::write(folder.join(name), lamp_scene("A")).unwrap();
        let output = etendue(&["measure", folder.join(name).to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let mut names: Vec<_> = std::fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["a.b.txt", "a.c.txt"]);
}

#[test]
fn a_place_that_cannot_be_written_is_told_with_what_to_type() {
    let folder = scratch("unwritable");
    std::fs::write(folder.join("file"), "").unwrap();
    std::fs::create_dir_all(folder.join("taken/photometric-bench.txt")).unwrap();
    for out in ["file", "file/below", "taken"] {
        let output = etendue(&["measure", "scenes/photometric-bench.ron", "--out", folder.join(out).to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{out}: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "{out}");
        assert!(stderr(&output).contains("--out takes a folder that can be written"), "{out}: {}", stderr(&output));
    }
    assert_eq!(std::fs::read_dir(folder.join("taken")).unwrap().count(), 1, "nothing half-written is left behind");
}

/// Several files are written together or not at all, and every place is told at once.
#[test]
fn a_folder_in_the_place_of_one_of_several_files_leaves_none_behind() {
    let folder = scratch("together");
    let commands: [(&[&str], &[&str]); 3] = [
        (&["datasheet", "sensors/ideal-illuminance-meter.ron"], &["sheet.json"]),
        #[cfg(feature = "image")]
        (
            &["expose", "scenes/flat-field-of-a-camera.ron", "--samples", "4", "--frames", "2"],
            &["camera-luminance.png", "camera-frame-0001.png"],
        ),
        #[cfg(not(feature = "image"))]
        (&["datasheet", "sensors/uv-index-sensor.ron"], &["sheet.txt"]),
        (&["calibrate", "scenes/calibration/monochromator.ron"], &["monochromator-readings.csv"]),
    ];
    for (k, (command, taken)) in commands.iter().enumerate() {
        let out = folder.join(k.to_string());
        taken.iter().for_each(|name| std::fs::create_dir_all(out.join(name)).unwrap());
        let output = etendue(&[command, &["--out", out.to_str().unwrap()][..]].concat());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{command:?}: {}", stderr(&output));
        assert!(taken.iter().all(|name| stderr(&output).contains(name)), "{command:?}: {}", stderr(&output));
        assert_eq!(std::fs::read_dir(&out).unwrap().count(), taken.len(), "{command:?}");
        // A folder that is made for a run that fails goes with it, and one that works is complete.
        taken.iter().for_each(|name| std::fs::remove_dir(out.join(name)).unwrap());
        let output = etendue(&[command, &["--out", out.to_str().unwrap()][..]].concat());
        assert_eq!(output.status.code(), Some(0), "{command:?}: {}", stderr(&output));
        let names: Vec<String> = std::fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        assert!(names.len() > 1 && taken.iter().all(|name| names.iter().any(|found| found == name)), "{names:?}");
        assert!(!names.iter().any(|name| name.ends_with(".partial")), "{names:?}");
    }
}

#[test]
fn whatever_a_file_holds_can_be_checked() {
    for (file, said) in [
        ("sensors/class-b-lux-meter.ron", "ok: a sensor with 1 channel"),
        ("sensors/rgb-camera.ron", "ok: a camera of 1200 × 840 pixels with 3 channels"),
        ("sensors/pixels/monochrome-12-bit.ron", "ok: a pixel of 14000 e⁻ and 12 bits"),
        ("scenes/calibration/monochromator.ron", "ok: a calibration with "),
        ("scenes/photometric-bench.ron", "ok: 1 source"),
    ] {
        let output = etendue(&["check", file]);
        let found = String::from_utf8(output.stdout.clone()).unwrap();
        assert!(output.status.success() && found.starts_with(said), "{file}: {found}{}", stderr(&output));
    }
    let folder = scratch("checked");
    let meter = folder.join("meter.ron");
    std::fs::write(&meter, "Sensor(aperture: Point, acceptance: Cosin, channels: [])").unwrap();
    let output = etendue(&["check", meter.to_str().unwrap()]);
    assert!(output.status.code() == Some(2) && stderr(&output).contains("did you mean `Cosine`"), "{}", stderr(&output));
}

/// A limit on the length of a file stands in for a full disk: it fails in the middle of writing as well.
#[cfg(unix)]
#[test]
fn what_does_not_fit_on_the_disk_fails_with_exit_code_one_and_leaves_nothing() {
    let folder = scratch("full");
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" measure scenes/photometric-bench.ron --format json --out \"$1\"";
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_etendue"), folder.to_str().unwrap()])
        .current_dir(root())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot write"), "{}", stderr(&output));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_a_file_is_refused_and_not_waited_for() {
    let folder = scratch("pipe");
    let pipe = folder.join("pipe.csv");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let scene = folder.join("scene.ron");
    std::fs::write(&scene, lamp_scene("pipe.csv")).unwrap();
    for path in [&pipe, &scene] {
        let output = etendue(&["check", path.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("it is not a file"), "{}", stderr(&output));
    }
}

#[cfg(unix)]
#[test]
fn the_exit_code_stands_when_nobody_reads_stderr() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut nowhere: Vec<std::process::Stdio> = vec![writer.into()];
    if let Ok(full) = std::fs::OpenOptions::new().write(true).open("/dev/full") {
        nowhere.push(full.into());
    }
    for stderr in nowhere {
        let mut command = Command::new(env!("CARGO_BIN_EXE_etendue"));
        let status = command.args(["check", "scenes/no-such-scene.ron"]).current_dir(root()).stderr(stderr).status().unwrap();
        assert_eq!(status.code(), Some(2));
    }
}

#[cfg(unix)]
#[test]
fn a_link_may_lead_anywhere_within_the_root_but_not_out_of_it() {
    use std::os::unix::fs::symlink;
    let folder = scratch("links");
    std::fs::create_dir_all(folder.join("lab/scenes")).unwrap();
    std::fs::create_dir_all(folder.join("lab/curves")).unwrap();
    let curve = "400,1\n700,2\n";
    for file in ["outside.csv", "lab/curves/inside.csv"] {
        std::fs::write(folder.join(file), curve).unwrap();
    }
    symlink("../curves/inside.csv", folder.join("lab/scenes/in.csv")).unwrap();
    symlink("../../outside.csv", folder.join("lab/scenes/out.csv")).unwrap();
    // A root that is itself reached by a link is a root like any other.
    symlink("lab", folder.join("by-link")).unwrap();
    for (curve, code) in [("in", 0), ("out", 2)] {
        std::fs::write(folder.join(format!("lab/scenes/{curve}.ron")), lamp_scene(&format!("{curve}.csv"))).unwrap();
        let (name, lab) = (format!("{curve}.ron"), folder.join("lab"));
        for (from, path) in
            [(folder.join("lab/scenes"), name.clone()), (lab, format!("scenes/{name}")), (folder.clone(), format!("by-link/scenes/{name}"))]
        {
            let output = Command::new(env!("CARGO_BIN_EXE_etendue")).args(["check", &path]).current_dir(from).output().unwrap();
            assert_eq!(output.status.code(), Some(code), "{path}: {}", stderr(&output));
            assert_eq!(stderr(&output).contains("the link leads out of the root"), code == 2, "{path}: {}", stderr(&output));
        }
    }
    let (scene, root) = (folder.join("lab/scenes/out.ron"), folder.to_str().unwrap());
    let output = etendue(&["check", scene.to_str().unwrap(), "--root", root]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

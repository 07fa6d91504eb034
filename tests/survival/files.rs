//! Checkpoints and shares that are not what they should be: told, and left as they were.

use std::fs;
use std::path::{Path, PathBuf};

use etendue::estimate::journal::{Recording, header_bytes};
use etendue::measurement::CheckpointHeader;

use crate::program::{BOX, done, etendue, name, refused, scratch, stderr, stdout, timeless};

/// A checkpoint of a finished run, made anew for each test.
fn finished(folder: &Path) -> PathBuf {
    let file = folder.join("run.checkpoint");
    done(&["measure", BOX, "--samples", "4096", "--checkpoint", name(&file)]);
    file
}

fn resume(file: &Path) -> Vec<&str> {
    vec!["measure", BOX, "--samples", "4096", "--checkpoint", name(file)]
}

/// Refused with these words; the file is as it was.
fn refused_untouched(arguments: &[&str], file: &Path, words: &[&str]) {
    let before = fs::read(file).unwrap();
    let message = refused(arguments);
    for word in words.iter().chain(&[name(file)]) {
        assert!(message.contains(word), "no `{word}` in\n{message}");
    }
    assert_eq!(fs::read(file).unwrap(), before, "{message}");
}

fn header_of(file: &Path) -> CheckpointHeader {
    CheckpointHeader::from_text(Recording::read(fs::read(file).unwrap()).unwrap().header()).unwrap()
}

#[test]
fn a_finished_checkpoint_reads_again_without_sampling() {
    let folder = scratch("finished");
    let file = finished(&folder);
    let before = fs::read(&file).unwrap();
    let json = ["--format", "json"];
    let again = etendue(&[&resume(&file)[..], &json].concat());
    assert!(stderr(&again).contains(", all of the run"), "{}", stderr(&again));
    assert!(stderr(&again).contains(" 0 sampled"), "{}", stderr(&again));
    assert_eq!(timeless(&stdout(&again)), timeless(&done(&["measure", BOX, "--samples", "4096", "--format", "json"])));
    assert_eq!(fs::read(&file).unwrap(), before);
}

#[test]
fn a_torn_end_is_told_and_cut() {
    let file = finished(&scratch("torn"));
    let whole = fs::read(&file).unwrap();
    for missing in [1, 20, 9000] {
        fs::write(&file, &whole[..whole.len() - missing]).unwrap();
        let again = etendue(&resume(&file));
        assert_eq!(again.status.code(), Some(0));
        for words in ["pieces of work are known", "bytes of a record that was being written are cut off"] {
            assert!(stderr(&again).contains(words), "no `{words}` in {}", stderr(&again));
        }
        // Threads write in any order: the largest cut may have taken the only records.
        let nothing_known = stderr(&again).contains(": 0 pieces of work are known");
        assert!(nothing_known && missing == 9000 || stderr(&again).contains("recalled"), "{}", stderr(&again));
        // The records that were lost are written again, on several threads in any order.
        let mended = Recording::read(fs::read(&file).unwrap()).unwrap();
        assert_eq!((mended.torn_bytes(), mended.whole_bytes()), (0, whole.len()));
        assert!(mended.completion().is_some());
    }
}

#[test]
fn a_checkpoint_of_another_run_is_told() {
    let folder = scratch("other-run");
    let file = finished(&folder);
    let cp = ["--checkpoint", name(&file)];
    for (options, words) in [
        (&["measure", BOX, "--samples", "4096", "--seed", "9"][..], &["seed: 9 here, 0 in the checkpoint"][..]),
        (&["measure", BOX, "--samples", "8192"], &["stop rule: 8192 samples here, 4096 samples in the checkpoint"]),
        (&["measure", BOX, "--target", "1%"], &["stop rule: target 0.01 here"]),
        (&["measure", BOX, "--samples", "4096", "--naive"], &["naive: true here, false in the checkpoint"]),
        (&["measure", BOX, "--samples", "4096", "--without", "behind_horizon"], &["rules switched off: behind_horizon here, none in"]),
        (&["measure", "scenes/office.ron", "--samples", "4096", "--seed", "1"], &["scene (a hash", "seed: 1 here"]),
        (&["measure", BOX, "--samples", "4096", "--shard", "1/2"], &["shard: 1/2 here, 1/1 in the checkpoint"]),
    ] {
        refused_untouched(&[options, &cp].concat(), &file, &[words, &["of another run", "name another file"]].concat());
    }
    // Of another version.
    let mut header = header_of(&file);
    header.provenance.version = "0.0.1".to_owned();
    fs::write(&file, header_bytes(&header.to_text())).unwrap();
    refused_untouched(&resume(&file), &file, &["version: ", "0.0.1 in the checkpoint"]);
}

#[test]
fn an_edited_or_mutilated_checkpoint_is_told() {
    let file = finished(&scratch("edited"));
    let whole = fs::read(&file).unwrap();
    let start = header_bytes(Recording::read(whole.clone()).unwrap().header()).len();
    let resume = resume(&file);
    let spoil = |bytes: &[u8], words: &[&str]| {
        fs::write(&file, bytes).unwrap();
        refused_untouched(&resume, &file, words);
    };
    let mut edited = whole.clone();
    edited[start + 100] ^= 1;
    spoil(&edited, &["record 1,", "damaged: its checksum", "head -c"]);
    let mut edited = whole.clone();
    // A length that reaches behind the end must not pass for a torn record.
    edited[start + 2] ^= 0x40;
    spoil(&edited, &["record 1,", "damaged: its length"]);
    let middle = start + (whole.len() - start) / 2;
    spoil(&[&whole[..middle], &whole[middle + 3..]].concat(), &["damaged"]);
    spoil(&[&whole[..], b"more words"].concat(), &["damaged"]);
    let mut edited = whole.clone();
    edited[start - 5] ^= 1;
    spoil(&edited, &["header", "edited", "name another file"]);
    spoil(&whole[..start - 10], &["header is cut short"]);
    spoil(b"", &["not a checkpoint"]);
    spoil(b"Scene(instruments: [])", &["not a checkpoint of this program", "name a file that does not exist yet"]);
    spoil(b"etendue checkpoint, format 7\n", &["format 7"]);
}

#[test]
fn places_that_cannot_hold_a_checkpoint_are_told() {
    let folder = scratch("places");
    assert!(refused(&resume(&folder)).contains("it is not a file"));
    assert!(refused(&resume(&folder.join("no/such/folder/x"))).contains("cannot write"));
    assert!(refused(&["merge", name(&folder.join("missing"))]).contains("missing"));
    // The scene is not overwritten when it is named by mistake.
    let scene = folder.join("scene.ron");
    fs::write(&scene, "Scene()").unwrap();
    refused_untouched(&resume(&scene), &scene, &["not a checkpoint"]);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "something was left behind");
}

#[test]
fn a_checkpoint_that_another_run_writes_to_is_left_alone() {
    let file = finished(&scratch("locked"));
    let held = fs::File::open(&file).unwrap();
    held.lock().unwrap();
    refused_untouched(&resume(&file), &file, &["another run writes to the checkpoint"]);
}

#[test]
fn options_that_do_not_go_together_are_told() {
    let file = scratch("options").join("x");
    let cp = ["--checkpoint", name(&file)];
    for (options, words) in [
        (&["--shard", "1/3"][..], &["--shard needs --samples", "--samples 65536"][..]),
        (&["--shard", "1/3", "--samples", "4096"], &["--shard needs --checkpoint"]),
        (&["--shard", "4/3", "--samples", "4096"], &["a share k/K with 1 ≤ k ≤ K"]),
        (&["--shard", "0/3", "--samples", "4096"], &["a share k/K with 1 ≤ k ≤ K"]),
        (&["--shard", "half", "--samples", "4096"], &["a share k/K with 1 ≤ k ≤ K"]),
        (&["--shard", "1/3", "--samples", "4096", "--checkpoint", name(&file), "--format", "json"], &["--format", "--shard"]),
        (&["--budget", "1s", "--checkpoint", name(&file)], &["--checkpoint does not go with --budget", "--target or --samples"]),
        (&["--checkpoint-every", "1s"], &["--checkpoint"]),
    ] {
        let message = refused(&[&["measure", BOX], options].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} in\n{message}");
    }
    assert!(!file.exists());
    let misspelt = refused(&[&["measure", BOX, "--samples", "4096", "--without", "nothing"], &cp[..]].concat());
    assert!(misspelt.contains("nothing") && !file.exists());
}

/// The files of so many shares.
fn shares(folder: &Path, of: u32, seed: &str) -> Vec<PathBuf> {
    (1..=of)
        .map(|number| {
            let file = folder.join(format!("{number}-of-{of}-seed-{seed}"));
            let share = format!("{number}/{of}");
            let run = ["measure", BOX, "--samples", "32768", "--seed", seed, "--shard", &share, "--checkpoint", name(&file)];
            let said = done(&run);
            assert!(said.starts_with(&format!("share {share}: ")) && said.contains(" pieces of work"), "{said}");
            file
        })
        .collect()
}

#[test]
fn shares_merge_into_the_bits_of_the_whole() {
    let folder = scratch("merge");
    let files = shares(&folder, 3, "4");
    let whole = done(&["measure", BOX, "--samples", "32768", "--seed", "4", "--format", "json"]);
    // In any order.
    for order in [[0, 1, 2], [2, 0, 1]] {
        let merge = [&["merge", "--format", "json"], &order.map(|i: usize| name(&files[i]))[..]].concat();
        assert_eq!(timeless(&done(&merge)), timeless(&whole));
    }
    let out = folder.join("out");
    let written = done(&["merge", "--out", name(&out), name(&files[0]), name(&files[1]), name(&files[2])]);
    assert!(written.trim_end().ends_with("cornell-box.txt") && out.join("cornell-box.txt").exists());
    // A finished run that was not shared is its own only share.
    let single = folder.join("whole");
    done(&["measure", BOX, "--samples", "32768", "--seed", "4", "--checkpoint", name(&single)]);
    assert_eq!(timeless(&done(&["merge", "--format", "json", name(&single)])), timeless(&whole));
}

#[test]
fn shares_that_are_no_whole_are_told() {
    let folder = scratch("no-whole");
    let (a, b, other) = (shares(&folder, 3, "0"), shares(&folder, 2, "0"), shares(&folder, 3, "1"));
    let before: Vec<Vec<u8>> = a.iter().chain(&b).chain(&other).map(|f| fs::read(f).unwrap()).collect();
    let unfinished = folder.join("unfinished");
    fs::write(&unfinished, &before[2][..before[2].len() / 2]).unwrap();
    let edited = folder.join("edited");
    let mut bytes = before[1].clone();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    fs::write(&edited, bytes).unwrap();
    for (files, words) in [
        (vec![&a[0], &a[2]], &["shares are missing: 2/3"][..]),
        (vec![&a[1]], &["shares are missing: 1/3, 3/3"]),
        (vec![&a[0], &a[1], &a[1]], &["share 2/3 is there 2 times", "shares are missing: 3/3"]),
        (vec![&a[0], &b[1]], &["is share 1/3", "is share 2/2", "they overlap"]),
        (vec![&a[0], &other[1], &a[2]], &["are of different runs", "seed: 0 in", "1 in"]),
        (vec![&a[0], &a[1], &unfinished], &["is not finished", "share 3/3", "repeat the command"]),
        (vec![&a[0], &edited, &a[2]], &["damaged", "edited"]),
        (vec![&a[0], &unfinished, &edited], &["damaged"]),
    ] {
        let names: Vec<&str> = files.iter().map(|f| name(f)).collect();
        let message = refused(&[&["merge"], &names[..]].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} in\n{message}");
    }
    let after: Vec<Vec<u8>> = a.iter().chain(&b).chain(&other).map(|f| fs::read(f).unwrap()).collect();
    assert!(before == after, "merging must not touch the shares");
}

#[test]
fn shares_of_a_scene_that_changed_are_told() {
    let folder = scratch("changed");
    let scene = folder.join("scene.ron");
    let text = |candela: u32| {
        format!(
            "Scene(sources: [(name: \"lamp\", shape: Sphere(0.1), at: (0, 0, 2), strength: Candela({candela}), spectrum: \"A\")],
            objects: [(name: \"screen\", shape: Quad(corner: (0, -1, 1), u: (1, 0, 0), v: (0, 2, 0)), surface: \"black\")],
            surfaces: {{ \"black\": Lambertian(0) }},
            instruments: [(name: \"meter\", at: (0, 0, 0), facing: (0, 0, 1), sensor: Sensor(title: \"ideal\", aperture: Point,
                acceptance: Cosine, channels: [(name: \"E_v\", responsivity: \"V\", reads: Illuminance)]))])"
        )
    };
    fs::write(&scene, text(100)).unwrap();
    let file = folder.join("share");
    done(&["measure", name(&scene), "--samples", "4096", "--shard", "1/1", "--checkpoint", name(&file)]);
    done(&["merge", name(&file)]);
    fs::write(&scene, text(101)).unwrap();
    let message = refused(&["merge", name(&file)]);
    assert!(message.contains("scene (a hash of all its files)"), "{message}");
    fs::remove_file(&scene).unwrap();
    let message = refused(&["merge", name(&file)]);
    assert!(message.contains("--scene FILE"), "{message}");
    let elsewhere = folder.join("elsewhere.ron");
    fs::write(&elsewhere, text(100)).unwrap();
    done(&["merge", name(&file), "--scene", name(&elsewhere)]);
}

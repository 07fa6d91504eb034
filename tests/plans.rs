//! The pages of `tests/plans/`: a scene, and what `etendue explain` says about it.
//!
//! A page is Markdown: a title, a sentence or two, one block `ron` with the scene, and blocks `explain`, `explain --naive` or
//! `explain --without RULE` with the plan in words. A page that is named after a rule shows the plan with it and without it, and the two
//! must differ. With `ETENDUE_REWRITE_EXPECTED=1` the plans are written anew; read each of them then as a stranger would.

mod disk;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use disk::{Repository, files_in, root};
use etendue::plan::{Plan, PlanOptions, reading_rule_names, rule_names};
use etendue::scene::{FileProblem, Files, Scene, read_scene};

const FOLDER: &str = "tests/plans";

/// The repository, with the scene of a page in the folder `scenes`.
struct Page<'a>(&'a str);

impl Files for Page<'_> {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileProblem> {
        if path == "scenes/page.ron" { Ok(self.0.as_bytes().to_vec()) } else { Repository.read(path, most_bytes) }
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        Repository.neighbours(path)
    }
}

/// Text outside of blocks, and blocks with what follows their opening fence.
enum Part {
    Prose(String),
    Block { info: String, body: String },
}

fn parts(page: &str) -> Vec<Part> {
    page.split("```")
        .enumerate()
        .map(|(i, text)| match text.split_once('\n') {
            Some((info, body)) if i % 2 == 1 => Part::Block { info: info.trim().to_owned(), body: body.to_owned() },
            _ => Part::Prose(text.to_owned()),
        })
        .collect()
}

fn options(info: &str) -> Option<PlanOptions> {
    let mut words = info.split_whitespace();
    if words.next() != Some("explain") {
        return None;
    }
    let mut options = PlanOptions::default();
    while let Some(word) = words.next() {
        match word {
            "--naive" => options.naive = true,
            "--without" => options.without.push(words.next().unwrap_or_default().to_owned()),
            other => panic!("unknown word `{other}` in a block `{info}`"),
        }
    }
    Some(options)
}

/// The page as it should be, and its plans by the words of their blocks.
fn written(name: &str, page: &str) -> (String, BTreeMap<String, String>) {
    let parts = parts(page);
    let text = parts.iter().find_map(|p| match p {
        Part::Block { info, body } if info == "ron" => Some(body.as_str()),
        _ => None,
    });
    let text = text.unwrap_or_else(|| panic!("{name}: no block `ron`"));
    let scene: Scene = read_scene("scenes/page.ron", &Page(text), None).unwrap_or_else(|problems| panic!("{name}:\n{problems}"));
    let mut plans = BTreeMap::new();
    let mut whole = String::new();
    for part in parts {
        match part {
            Part::Prose(prose) => whole += &prose,
            Part::Block { info, body } => {
                let body = match options(&info) {
                    Some(options) => {
                        let explained = Plan::new(&scene, &options).unwrap_or_else(|e| panic!("{name}: {e}")).explain(&scene);
                        plans.insert(info.clone(), explained.clone());
                        explained
                    }
                    None => body,
                };
                whole += &format!("```{info}\n{body}```");
            }
        }
    }
    (whole, plans)
}

#[test]
fn the_plans_are_explained_as_the_pages_say() {
    let rewrite = std::env::var_os("ETENDUE_REWRITE_EXPECTED").is_some();
    let mut wrong = Vec::new();
    for name in files_in(FOLDER, &[".md"]) {
        let path = root().join(FOLDER).join(&name);
        let page = fs::read_to_string(&path).unwrap();
        let (whole, plans) = written(&name, &page);
        assert!(!plans.is_empty(), "{name}: no block `explain`");
        if rewrite {
            fs::write(&path, whole).unwrap();
        } else if whole != page {
            wrong.push(format!("{name}, as it is now:\n{whole}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_rule_has_a_page_that_shows_what_it_does() {
    for rule in rule_names() {
        let name = format!("{rule}.md");
        let page =
            fs::read_to_string(root().join(FOLDER).join(&name)).unwrap_or_else(|_| panic!("the rule `{rule}` has no page {FOLDER}/{name}"));
        let (_, plans) = written(&name, &page);
        let with = plans.get("explain").unwrap_or_else(|| panic!("{name}: no block `explain`"));
        let without =
            plans.get(&format!("explain --without {rule}")).unwrap_or_else(|| panic!("{name}: no block `explain --without {rule}`"));
        let without: String = without.lines().filter(|line| !line.starts_with("switched off:")).map(|line| format!("{line}\n")).collect();
        assert_ne!(*with, without, "{name}: the rule changes nothing");
        assert!(with.contains(&format!("({rule})")), "{name}: not named where it acts");
        assert!(!without.contains(&format!("({rule})")), "{name}: named although it is switched off");
    }
}

/// The names in brackets that a line of a plan ends its phrases with.
fn named(line: &str) -> BTreeSet<&str> {
    let inner = line.split('(').skip(1).filter_map(|rest| rest.split_once(')'));
    inner.map(|(name, _)| name).filter(|name| reading_rule_names().contains(name)).collect()
}

#[test]
fn explain_names_exactly_the_rules_that_act() {
    let mut seen = BTreeSet::new();
    for folder in ["scenes", "scenes/lecture"] {
        for file in files_in(folder, &[".ron"]) {
            let scene = read_scene(&format!("{folder}/{file}"), &Repository, None).unwrap_or_else(|problems| panic!("{problems}"));
            // The rules of cameras are no rules of terms; their pages show them.
            if !scene.cameras.is_empty() {
                continue;
            }
            for without in std::iter::once(None).chain(reading_rule_names().into_iter().map(Some)) {
                let options = PlanOptions { naive: false, without: without.map(str::to_owned).into_iter().collect() };
                let plan = Plan::new(&scene, &options).unwrap();
                let explained = plan.explain(&scene);
                let rows =
                    explained.lines().filter(|l| ["kept ", "left out ", "narrowed "].iter().any(|verb| l.trim_start().starts_with(verb)));
                let mut cited = BTreeSet::new();
                for row in rows {
                    let names = named(row);
                    let by_rays = ["sample the source, shadow rays", "sample the sky, shadow rays", "paths with next-event estimation"];
                    assert_eq!(names.is_empty(), by_rays.iter().any(|words| row.ends_with(words)), "{file}: {row}");
                    cited.extend(names);
                }
                assert_eq!(cited, plan.acting().into_iter().collect(), "{file} without {without:?}\n{explained}");
                seen.extend(cited.iter().map(ToString::to_string));
            }
            assert!(Plan::new(&scene, &PlanOptions { naive: true, without: Vec::new() }).unwrap().acting().is_empty(), "{file}");
        }
    }
    assert_eq!(seen, reading_rule_names().into_iter().map(str::to_owned).collect(), "rules that no scene of the shelf shows");
}

//! The syntax of documents, held against the `ron` crate.

use proptest::prelude::*;
use ron::Value as Oracle;

use crate::scene::document::{Body, DEEPEST_NESTING, Document, Kind, Node};

/// Texts of values: every kind, with blanks, comments and trailing commas.
fn any_value() -> impl Strategy<Value = String> {
    let blank = || prop_oneof![Just(""), Just(" "), Just("\n  "), Just(" // one } line\n"), Just("/* a /* nested ) */ block */")];
    let leaf = prop_oneof![
        any::<i32>().prop_map(|x| x.to_string()),
        (-1e300..1e300_f64).prop_map(|x| format!("{x:?}")),
        prop_oneof![
            Just("1e-4"),
            Just("+2.5E+3"),
            Just("-.5"),
            Just("7."),
            Just("1_000"),
            Just("inf"),
            Just("-inf"),
            Just("true"),
            Just("false")
        ]
        .prop_map(str::to_string),
        "[a-zA-Zλ0-9 ,:()]{0,8}".prop_map(|text| format!("{text:?}")),
        Just(r##"r#"a "raw" \ text"#"##.to_string()),
        Just(r#""\n\t\\\"\u{3bb}\x41""#.to_string()),
        "[A-Z][a-z_0-9]{1,5}".prop_map(|name| name),
    ];
    leaf.prop_recursive(4, 24, 4, move |inner| {
        let items = || prop::collection::vec((inner.clone(), blank()), 0..4);
        let name = prop_oneof![Just(String::new()), "[A-Z][a-z]{2,5}"];
        let joined = |items: Vec<(String, &'static str)>, comma: bool| {
            let list: Vec<String> = items.into_iter().map(|(item, blank)| format!("{blank}{item}{blank}")).collect();
            let end = if comma && !list.is_empty() { "," } else { "" };
            format!("{}{end}", list.join(","))
        };
        let keyed = |items: Vec<(String, &'static str)>, quote: &str| -> Vec<(String, &'static str)> {
            items.into_iter().enumerate().map(|(i, (item, blank))| (format!("{quote}k{i}{quote}{blank}:{blank}{item}"), blank)).collect()
        };
        prop_oneof![
            (items(), any::<bool>()).prop_map(move |(i, c)| format!("[{}]", joined(i, c))),
            (items(), any::<bool>()).prop_map(move |(i, c)| format!("{{{}}}", joined(keyed(i, "\""), c))),
            (name.clone(), items(), any::<bool>()).prop_map(move |(n, i, c)| format!("{n}({})", joined(keyed(i, ""), c))),
            (name, prop::collection::vec((inner.clone(), blank()), 2..4), any::<bool>())
                .prop_map(move |(n, i, c)| format!("{n}({})", joined(i, c))),
        ]
    })
}

/// Whether a value is what the oracle made of the same text. The oracle drops names and writes structs as maps.
fn same(node: &Node, oracle: &Oracle) -> bool {
    let list = |nodes: &[Node], values: &[Oracle]| nodes.len() == values.len() && nodes.iter().zip(values).all(|(n, v)| same(n, v));
    match (&node.kind, oracle) {
        (Kind::Number(x), Oracle::Number(number)) => {
            // The oracle keeps what fits in single precision so.
            let y = number.into_f64();
            *x == y || (x - y).abs() <= 1e-7 * x.abs()
        }
        (Kind::Text(a), Oracle::String(b)) => a == b,
        (Kind::Bool(a), Oracle::Bool(b)) => a == b,
        (Kind::List(nodes), Oracle::Seq(values)) => list(nodes, values),
        (Kind::Map(entries), Oracle::Map(map)) => {
            entries.len() == map.len() && entries.iter().zip(map.iter()).all(|((k, v), (ok, ov))| same(k, ok) && same(v, ov))
        }
        (Kind::Struct { body: Body::None, .. }, Oracle::Unit) => true,
        (Kind::Struct { body: Body::Positional(nodes), .. }, Oracle::Unit) => nodes.is_empty(),
        (Kind::Struct { body: Body::Positional(nodes), .. }, Oracle::Seq(values)) => list(nodes, values),
        (Kind::Struct { body: Body::Named(fields), .. }, Oracle::Map(map)) => {
            fields.len() == map.len()
                && fields
                    .iter()
                    .zip(map.iter())
                    .all(|(field, (key, value))| matches!(key, Oracle::String(k) if *k == field.name) && same(&field.value, value))
        }
        _ => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn what_is_read_is_what_the_notation_says(text in any_value()) {
        let document = Document::parse("x", &text).map_err(|problem| TestCaseError::fail(format!("{problem}")))?;
        let oracle: Oracle = ron::from_str(&text).map_err(|problem| TestCaseError::fail(format!("{problem}: {text}")))?;
        prop_assert!(same(&document.root, &oracle), "{:?} is not {:?}", document.root, oracle);
    }

    #[test]
    fn a_text_with_a_piece_cut_out_is_read_if_the_notation_allows_it(text in any_value(), from in 0.0..1.0_f64, length in 1..4usize) {
        let characters: Vec<char> = text.chars().collect();
        let from = (from * characters.len() as f64) as usize;
        let cut: String = characters.iter().enumerate().filter(|(i, _)| *i < from || *i >= from + length).map(|(_, c)| *c).collect();
        let (read, oracle) = (Document::parse("x", &cut), ron::from_str::<Oracle>(&cut));
        prop_assert_eq!(read.is_ok(), oracle.is_ok(), "{}\n{:?}\n{:?}", cut, read.err().map(|p| p.to_string()), oracle.err());
    }

    #[test]
    fn every_value_knows_its_place(text in any_value()) {
        fn check(node: &Node, text: &str) -> Result<(), TestCaseError> {
            let piece = text.get(node.span.clone()).ok_or_else(|| TestCaseError::fail("no such place"))?;
            let alone = Document::parse("x", piece).map_err(|p| TestCaseError::fail(p.to_string()))?;
            prop_assert!(alone.root.span == (0..piece.len()));
            match &node.kind {
                Kind::List(nodes) | Kind::Struct { body: Body::Positional(nodes), .. } => nodes.iter().try_for_each(|n| check(n, text)),
                Kind::Map(entries) => entries.iter().try_for_each(|(k, v)| check(k, text).and_then(|()| check(v, text))),
                Kind::Struct { body: Body::Named(fields), .. } => fields.iter().try_for_each(|f| {
                    prop_assert_eq!(text.get(f.name_span.clone()), Some(f.name.as_str()));
                    check(&f.value, text)
                }),
                _ => Ok(()),
            }
        }
        let document = Document::parse("x", &text).map_err(|problem| TestCaseError::fail(format!("{problem}")))?;
        check(&document.root, &text)?;
    }
}

#[test]
fn brackets_nest_as_deep_as_stated_and_no_deeper() {
    let nested = |depth: usize| format!("{}{}", "[".repeat(depth), "]".repeat(depth));
    assert!(Document::parse("x", &nested(DEEPEST_NESTING)).is_ok());
    assert!(Document::parse("x", &nested(DEEPEST_NESTING + 1)).is_err());
}

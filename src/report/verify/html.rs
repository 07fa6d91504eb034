//! A verification as one page of HTML that needs nothing beside it: style and pictures are in it, and nothing is loaded.
//!
//! Pictures are drawn twice, light and dark; `prefers-color-scheme` chooses. Every text that is not ours is escaped.

use std::fmt::Write;

use super::{cells, chart, in_place_of_value, largest, sentence, small};
use crate::report::plot::{Chart, PlotError, Size, Style, Theme, svg};
use crate::study::verify::{Check, Summary, Verification};

const SIZE: Size = Size::Custom { width_px: 1120, height_px: 440 };

const CSS: &str = "
:root{color-scheme:light dark;--ground:#fff;--text:#262a33;--muted:#6a717e;--line:#e6e9ee;--card:#f6f7fa;--good:#2b6b3f;--bad:#b3261e}
@media (prefers-color-scheme:dark){:root{--ground:#14171d;--text:#e8eaef;--muted:#969daa;--line:#2b3039;--card:#1c2027;--good:#8fd6a3;--bad:#ff8a80}
.light{display:none}}
@media (prefers-color-scheme:light){.dark{display:none}}
@media print{.dark{display:none}.light{display:block}}
*{box-sizing:border-box}
body{margin:0 auto;padding:2.5rem 1.5rem 4rem;max-width:1168px;background:var(--ground);color:var(--text);font:15px/1.5 system-ui,sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem}
h2{font-size:1.15rem;margin:2.4rem 0 .6rem}
p{margin:.3rem 0;max-width:75ch}
.verdict{font-size:1.1rem;font-weight:600;color:var(--good)}
.verdict.bad,.bad{color:var(--bad)}
.muted{color:var(--muted)}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem 1rem;margin:1rem 0}
dt{color:var(--muted)}dd{margin:0}
figure{margin:1rem 0}
svg{width:100%;height:auto;display:block}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:.87rem}
th,td{padding:.25rem .6rem;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap;vertical-align:top}
th{color:var(--muted);font-weight:500}
th:first-child,td:first-child,.words{text-align:left}
.words{white-space:normal;min-width:16rem}
tr.sum td{font-weight:600}
details{border:1px solid var(--line);border-radius:6px;margin:.5rem 0;background:var(--card)}
details>.scroll{background:var(--ground);padding:.3rem .4rem;border-radius:0 0 6px 6px}
summary{cursor:pointer;padding:.45rem .8rem}
";

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

fn picture(chart: &Chart) -> Result<String, PlotError> {
    let mut out = String::new();
    for (theme, class) in [(Theme::Light, "light"), (Theme::Dark, "dark")] {
        let drawn = svg(chart, &Style { theme, size: SIZE })?;
        // A document of its own may open with a declaration that has no place in HTML.
        let drawn = drawn.find("<svg").map_or("", |at| &drawn[at..]);
        let _ = writeln!(out, "<figure class=\"{class}\" role=\"img\" aria-label=\"{}\">{drawn}</figure>", escaped(&chart.title));
    }
    Ok(out)
}

fn row(cells: &[String], class: &str) -> String {
    let cells: String = cells.iter().map(|cell| format!("<td>{}</td>", escaped(cell))).collect();
    format!("<tr{class}>{cells}</tr>\n")
}

fn summary_table(of: &Verification) -> String {
    let heads = ["group", "cases", "agree", "fail", "wait", "behaviour", "largest, of limit", "case", "largest, in u", "time / s"];
    let heads: String = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    let line = |sum: &Summary, class: &str| {
        let ([limit, case], [u, _]) = (largest(&sum.largest), largest(&sum.largest_in_u));
        let name = if sum.title.is_empty() { sum.name.clone() } else { format!("{} {}", sum.name, sum.title) };
        let counts = [sum.cases(), sum.agree, sum.fail, sum.wait, sum.behaviours].map(|count| count.to_string());
        row(&[vec![name], counts.to_vec(), vec![limit, case, u, format!("{:.2}", sum.seconds)]].concat(), class)
    };
    let parts = of.parts();
    let mut rows = String::new();
    for group in of.groups() {
        rows.push_str(&line(&group, " class=\"sum\""));
        let own = parts.iter().filter(|part| of.checks.iter().any(|check| check.part == part.name && check.group == group.name));
        rows.extend(own.map(|part| line(part, "")));
    }
    rows.push_str(&line(&of.total(), " class=\"sum\""));
    format!("<div class=\"scroll\"><table><thead><tr>{heads}</tr></thead><tbody>\n{rows}</tbody></table></div>\n")
}

fn case_row(check: &Check) -> String {
    let class = if check.fails() { " class=\"bad\"" } else { "" };
    let title = escaped(&check.title);
    match cells(check) {
        Some([id, rest @ ..]) => {
            let numbers: String = rest.iter().map(|cell| format!("<td>{}</td>", escaped(cell))).collect();
            format!("<tr{class}><td>{}</td><td class=\"words\">{title}</td>{numbers}<td>{}</td></tr>\n", escaped(&id), check.word())
        }
        None => {
            let why = match (check.fails(), check.reason()) {
                (false, Some(behaviour)) if check.word() == "behaviour" => format!("{}: {behaviour}", in_place_of_value(check)),
                _ => in_place_of_value(check),
            };
            let id = escaped(&check.id);
            format!(
                "<tr{class}><td>{id}</td><td class=\"words\">{title}</td><td class=\"words\" colspan=\"6\">{}</td><td>{}</td></tr>\n",
                escaped(&why),
                check.word()
            )
        }
    }
}

fn cases(of: &Verification) -> String {
    let heads = ["case", "what", "reference", "reading", "relative", "in u", "of limit", "ms", "verdict"];
    let heads: String = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    let mut out = String::new();
    for part in of.parts() {
        let rows: String = of.checks.iter().filter(|check| check.part == part.name).map(case_row).collect();
        let open = if part.fail > 0 { " open" } else { "" };
        let [limit, _] = largest(&part.largest);
        let fails = if part.fail > 0 { format!(" · <span class=\"bad\">{} fail</span>", part.fail) } else { String::new() };
        let _ = write!(
            out,
            "<details{open}><summary><strong>{}</strong> · {} cases, {} agree{fails} · <span class=\"muted\">largest deviation {limit} of the \
             limit</span></summary>\n<div class=\"scroll\"><table><thead><tr>{heads}</tr></thead><tbody>\n{rows}</tbody></table></div></details>\n",
            escaped(&part.name),
            part.cases(),
            part.agree,
        );
    }
    out
}

/// The page. `about` says in pairs of name and value where it was made: version, machine, date.
///
/// # Errors
/// When a picture cannot be drawn.
pub fn page(of: &Verification, about: &[(String, String)]) -> Result<String, PlotError> {
    let about: String = about.iter().map(|(name, value)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value))).collect();
    let (deviations, times) = (picture(&chart::deviations(of))?, picture(&chart::times(of))?);
    let class = if of.passed() { "verdict" } else { "verdict bad" };
    let slowest = of.checks.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let slowest = slowest.map_or_else(String::new, |check| format!("Slowest: {}, {} s.", escaped(&check.id), small(Some(check.seconds))));
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <title>Étendue: verification</title>\n<style>{CSS}</style>\n</head>\n<body>\n<h1>Verification of Étendue</h1>\n<p class=\"{class}\">{}</p>\n\
         <dl>\n{about}</dl>\n<p class=\"muted\">Of limit: |reading − reference| over the tolerance of the case, or, for a sampled reading, over k u at the level 1 − 10⁻⁴ \
         if that is larger; above 1 a case fails. In u: the deviation over the standard uncertainty that the reading states. Tolerances come with the \
         references, each computed by two routes outside this program.</p>\n{deviations}<h2>By group</h2>\n{}<h2>Case by case</h2>\n{}<h2>Time</h2>\n\
         <p>{slowest}</p>\n{times}</body>\n</html>\n",
        escaped(&sentence(of)),
        summary_table(of),
        cases(of),
    ))
}

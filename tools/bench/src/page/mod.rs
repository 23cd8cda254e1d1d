//! The page: one HTML text that holds every table and every figure and asks for nothing else.

#[cfg(test)]
pub mod check;
mod table;

use crate::report::{Figure, Section, Table};
use std::fmt::Write;

const STYLE: &str = include_str!("style.css");

/// A part as the page shows it.
#[derive(Clone, Debug)]
pub struct Chapter {
    /// The part's name.
    pub name: &'static str,
    /// What measures it again; empty if nothing does.
    pub command: String,
    /// What it found, or why it failed.
    pub outcome: Result<Section, String>,
}

/// The page: tables about the whole run, then the chapters.
pub fn html(about: &[Table], chapters: &[Chapter]) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>raysteps: run time against error</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>raysteps: run time against error</h1>\n{}<div class=\"tables\">\n",
        contents(chapters)
    );
    about.iter().for_each(|table| page.push_str(&table::html(table)));
    page.push_str(LEGEND);
    chapters.iter().for_each(|chapter| page.push_str(&html_of_chapter(chapter)));
    page.push_str("</body>\n</html>\n");
    page
}

const LEGEND: &str = "</div>\n<p class=\"remarks\">Figures that move from run to run are medians with \
    (lower-upper quartile); ± is half a 95 % interval. ↓ less is better, ↑ more is better. Where rows do the same \
    work, the best of a column is coloured; ★ and rings: nothing beats it in both price and quality.</p>\n";

fn contents(chapters: &[Chapter]) -> String {
    let line = |c: &Chapter| {
        let failed = if c.failed() { " <span class=\"error\">(failed)</span>" } else { "" };
        format!("<li><a href=\"#{0}\">{0}</a>{failed}</li>\n", c.name)
    };
    let lines: String = chapters.iter().map(line).collect();
    format!("<nav>\n<ul>\n{lines}</ul>\n</nav>\n")
}

impl Chapter {
    /// Whether it could not be measured, or something that it found is wrong.
    pub fn failed(&self) -> bool {
        self.outcome.as_ref().map_or(true, |section| !section.faults.is_empty())
    }
}

fn html_of_chapter(chapter: &Chapter) -> String {
    let title = chapter.outcome.as_ref().map_or("", |section| &section.title);
    let mut text = format!("<section id=\"{0}\">\n<h2>{0}: {1}</h2>\n", chapter.name, escaped(title));
    if !chapter.command.is_empty() {
        let _ = writeln!(text, "<p><code>{}</code></p>", escaped(&chapter.command));
    }
    match &chapter.outcome {
        Ok(section) => text.push_str(&html_of_section(section)),
        Err(why) => {
            let _ = writeln!(text, "<p class=\"error\">{}</p>", escaped(why));
        }
    }
    text + "</section>\n"
}

fn html_of_section(section: &Section) -> String {
    let mut text = items("remarks", &section.remarks) + &items("faults", &section.faults);
    text.push_str("<div class=\"figures\">\n");
    section.figures.iter().for_each(|figure| text.push_str(&html_of_figure(figure)));
    text.push_str("</div>\n<div class=\"tables\">\n");
    section.tables.iter().for_each(|table| text.push_str(&table::html(table)));
    text + "</div>\n"
}

fn items(class: &str, lines: &[String]) -> String {
    let item = |line: &String| format!("<li>{}</li>\n", escaped(line));
    let items: String = lines.iter().map(item).collect();
    if items.is_empty() { items } else { format!("<ul class=\"{class}\">\n{items}</ul>\n") }
}

/// A figure as part of the page: its size is the page's to choose, and within HTML it needs no
/// name space.
fn html_of_figure(figure: &Figure) -> String {
    let svg = match figure.svg() {
        Ok(svg) => svg,
        Err(why) => return format!("<p class=\"error\">{}</p>\n", escaped(&why.report())),
    };
    let (head, body) = svg.split_once('>').unwrap_or_default();
    let view = head.split("viewBox=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap_or_default();
    let title = escaped(&figure.title);
    format!(
        "<figure>\n<svg viewBox=\"{view}\" role=\"img\" aria-label=\"{title}\">{}\n</figure>\n",
        body.trim_end()
    )
}

/// Text in which nothing is a tag.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Better, Cell, Curve};

    fn section() -> Section {
        let mut table = Table::of_rivals("a < b", "it", &[("ms", Better::Less), ("x", Better::More)]);
        table.row("<i>", [Cell::Exact(1.0), Cell::estimate(2.0, 0.5)]);
        table.row("k & l", [Cell::Exact(3.0), Cell::from("\"word\"")]);
        table.mark_front("ms", "x", |_| true);
        let curves = vec![Curve::new("q & <r>", [(1.0, 1.0), (2.0, 3.0)])];
        let figure = Figure::new("f > g", "s", "t", curves).with_front(Better::Less);
        let faults = vec!["5 > 4".to_owned()];
        let (tables, figures) = (vec![table], vec![figure, Figure::default()]);
        Section { part: "rays", title: "A & B".to_owned(), tables, figures, faults, ..Section::default() }
    }

    #[test]
    fn the_page_is_whole_and_nothing_in_it_is_mistaken_for_a_tag() {
        let bad = Chapter { name: "path", command: String::new(), outcome: Err("<why>".to_owned()) };
        let good = Chapter { name: "rays", command: "run <it>".to_owned(), outcome: Ok(section()) };
        let page = html(&[section().tables.remove(0)], &[good, bad]);
        check::assert_self_contained(&page);
        for part in [
            "<h2>rays: A &amp; B</h2>",
            "<caption>a &lt; b</caption>",
            "&lt;why&gt;",
            "<li>5 &gt; 4</li>",
            "<td class=\"best\">1.00</td>",
            "2.00 <small>± 0.500</small> ★",
            "viewBox=\"0 0 1120 560\"",
        ] {
            assert!(page.contains(part), "{part} is not in {page}");
        }
        assert_eq!((page.matches("<table").count(), page.matches("<svg").count()), (2, 1));
    }
}

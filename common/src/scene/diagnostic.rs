//! Errors of scene files: where, what was expected, what was probably meant.
//! This is the door to `annotate-snippets`.
//!
//! ```text
//! error: expected a number for `radius`, found `}`
//!   --> scene.txt:14:31
//!    |
//! 14 |     Sphere { center 0 0 0 radius }
//!    |                                  ^
//! ```

use super::Position;
use super::excerpt::Excerpt;
use super::lexer::Span;
use super::line_counter::position_of;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

/// An error in a scene file. `Display` gives the whole report: the message, the file, line and
/// column, the line itself with a caret, and a hint where there is one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.render())]
pub struct SceneError(Box<Report>);

/// What a report is drawn from when somebody wants to read it: to draw it takes longer than to
/// read the file.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Report {
    file: String,
    position: Option<Position>,
    message: String,
    /// Words at the caret, and at the second place.
    labels: [Option<String>; 2],
    help: Option<String>,
    excerpts: Vec<Excerpt>,
}

impl SceneError {
    /// An error of the whole file (it cannot be read, say), without a position.
    pub(super) fn of_file(file: &str, message: String, help: Option<String>) -> Self {
        let (labels, excerpts) = Default::default();
        Self(Box::new(Report { file: file.to_owned(), position: None, message, labels, help, excerpts }))
    }

    /// The scene file's name, as it was given to the loader.
    pub fn file(&self) -> &str {
        &self.0.file
    }

    /// Where in the file; `None` if the file could not be read as text at all.
    pub fn position(&self) -> Option<Position> {
        self.0.position
    }

    /// What is wrong, in one line without the position.
    pub fn message(&self) -> &str {
        &self.0.message
    }
}

/// An error as the parser raises it: spans instead of rendered text.
#[derive(Debug, Clone)]
pub(super) struct Fault {
    span: Span,
    message: String,
    label: Option<String>,
    context: Option<(Span, String)>,
    help: Option<String>,
}

/// Result of everything in the parser; the fault is boxed to keep the good case small.
pub(super) type Parsed<T> = Result<T, Box<Fault>>;

impl Fault {
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), label: None, context: None, help: None }
    }

    /// Words at the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// A second place that explains the first, such as "first given here".
    pub fn context(mut self, span: Span, label: impl Into<String>) -> Self {
        self.context = Some((span, label.into()));
        self
    }

    /// A hint what to do, below the excerpt.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    pub fn help_if_any(mut self, help: Option<String>) -> Self {
        self.help = help;
        self
    }

    /// As the `Err` of a parsing function.
    pub fn fail<T>(self) -> Parsed<T> {
        Err(Box::new(self))
    }

    /// The fault in the text it was found in, of which only what will be shown is kept.
    pub fn into_error(self, file: &str, text: &str) -> SceneError {
        let (second, second_label) = self.context.unzip();
        SceneError(Box::new(Report {
            file: file.to_owned(),
            position: Some(position_of(text, self.span.start)),
            message: self.message,
            labels: [self.label, second_label],
            help: self.help,
            excerpts: Excerpt::around(text, self.span, second),
        }))
    }
}

impl Report {
    fn render(&self) -> String {
        let mut group = Group::with_title(Level::ERROR.primary_title(&self.message));
        if self.position.is_none() {
            group = group.element(Origin::path(&self.file));
        }
        for excerpt in &self.excerpts {
            group = group.element(self.snippet(excerpt));
        }
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help));
        }
        let report = Renderer::plain().render(&[group]);
        match self.position {
            Some(position) => with_origin(&report, &self.file, position),
            None => report,
        }
    }

    fn snippet<'a>(&'a self, excerpt: &'a Excerpt) -> Snippet<'a, Annotation<'a>> {
        let marks = [AnnotationKind::Primary, AnnotationKind::Context];
        let ranges = [&excerpt.primary, &excerpt.context];
        let annotations = marks
            .into_iter()
            .zip(ranges)
            .zip(&self.labels)
            .filter_map(|((kind, range), label)| Some(kind.span(range.clone()?).label(label.as_deref())));
        Snippet::source(excerpt.text.as_str()).line_start(excerpt.first_line).annotations(annotations)
    }
}

/// Puts the line `--> file:line:column` below the title, and cuts blanks at line ends. The
/// renderer would take the column from the excerpt, where that of a clipped line is not right.
fn with_origin(report: &str, file: &str, at: Position) -> String {
    let mut lines = report.lines().map(str::trim_end);
    let title = lines.next().unwrap_or_default();
    let body: Vec<&str> = lines.collect();
    let bar = body.first().and_then(|line| line.find('|')).unwrap_or(1);
    let arrow = format!("{:>1$}", "--> ", bar + 3);
    let (line, column) = (at.line, at.column);
    format!("{title}\n{arrow}{file}:{line}:{column}\n{}", body.join("\n"))
}

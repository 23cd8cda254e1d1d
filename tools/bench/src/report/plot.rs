//! Figures as SVG: the door to plotters.

use super::{Curve, Figure, Upward};
use common::cli::AppError;
use plotters::coord::Shift;
use plotters::coord::combinators::LogCoord;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;

/// Family and size of all text but the caption.
const FONT: (&str, u32) = ("sans-serif", 17);
/// Width and height in pixels.
const SIZE: (u32, u32) = (1120, 560);
/// Pixels that the legend takes at the right.
const LEGEND: u32 = 250;
/// Radius of the rings around points of the front.
const RING: i32 = 7;

/// The text of a figure. Points that the axes have no place for (a logarithm has none for 0) are left
/// out, and the title says how many.
///
/// # Errors
/// If no point is left.
pub fn svg(figure: &Figure) -> Result<String, AppError> {
    let figure = &shown(figure);
    let points = || figure.curves.iter().flat_map(|c| c.points.iter());
    let range = |of: fn(&(f64, f64)) -> f64| {
        points().map(of).fold((f64::INFINITY, 0.0f64), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let ((min, max), (bottom, top)) = (range(|p| p.0), range(|p| p.1));
    if min > max {
        return Err(AppError::CheckFailed(format!("`{}`: there is nothing to draw", figure.title)));
    }
    let mut text = String::new();
    let across = factors(min / 1.1, max * 1.1);
    match figure.upward {
        Upward::Linear => {
            let up: Axis<_> = (0.0..top * 1.05, Box::new(|y| number(*y)));
            picture(&mut text, figure, across, up)
        }
        Upward::Logarithmic => picture(&mut text, figure, across, factors(bottom / 1.2, top * 1.2)),
    }
    .map_err(|e| AppError::CheckFailed(format!("cannot draw `{}`: {e}", figure.title)))?;
    Ok(text)
}

/// The figure without points that have no place.
fn shown(figure: &Figure) -> Figure {
    let mut shown = figure.clone();
    let upward = figure.upward;
    let has_place = |(x, y): &(f64, f64)| {
        let above = if upward == Upward::Linear { *y >= 0.0 } else { *y > 0.0 };
        x.is_finite() && y.is_finite() && *x > 0.0 && above
    };
    shown.curves.iter_mut().chain(&mut shown.fits).for_each(|curve| curve.points.retain(has_place));
    shown.front.retain(has_place);
    let count = |figure: &Figure| figure.curves.iter().map(|c| c.points.len()).sum::<usize>();
    let lost = count(figure) - count(&shown);
    if lost > 0 {
        shown.title = format!("{} (but for {lost} points at 0 or without end)", figure.title);
    }
    shown
}

fn picture<X, Y>(
    text: &mut String,
    figure: &Figure,
    across: Axis<X>,
    up: Axis<Y>,
) -> Result<(), Box<dyn std::error::Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let (left, right) = area.split_horizontally(SIZE.0 - LEGEND);
    let mut chart = ChartBuilder::on(&left)
        .caption(&figure.title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(50)
        .y_label_area_size(75)
        .build_cartesian_2d(across.0, up.0)?;
    chart
        .configure_mesh()
        .x_desc(&figure.across)
        .y_desc(&figure.up)
        .label_style(FONT)
        .axis_desc_style(FONT)
        .x_label_formatter(&across.1)
        .y_label_formatter(&up.1)
        .max_light_lines(0)
        .draw()?;
    for (i, Curve { points, .. }) in figure.curves.iter().enumerate() {
        let color = color(i, figure);
        chart.draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)))?;
        chart.draw_series(points.iter().map(|p| Circle::new(*p, 3, color.filled())))?;
    }
    for (i, Curve { points, .. }) in figure.fits.iter().enumerate() {
        chart.draw_series(LineSeries::new(points.iter().copied(), color(i, figure).mix(0.5)))?;
    }
    chart.draw_series(figure.front.iter().map(|p| Circle::new(*p, RING, BLACK.stroke_width(1))))?;
    legend(&right, figure)?;
    area.present()?;
    Ok(())
}

/// Names beside their colours, outside of the picture, where nothing can be hidden.
fn legend(area: &DrawingArea<SVGBackend, Shift>, figure: &Figure) -> Result<(), Box<dyn std::error::Error>> {
    let text = |name: &str, y| Text::new(name.to_owned(), (32, y - 8), FONT);
    let place = |line: usize| 60 + 22 * line as i32;
    for (i, curve) in figure.curves.iter().enumerate() {
        let y = place(i);
        let color = color(i, figure);
        area.draw(&PathElement::new([(4, y), (26, y)], color.stroke_width(2)))?;
        area.draw(&Circle::new((15, y), 3, color.filled()))?;
        area.draw(&text(&curve.name, y))?;
    }
    let mut y = place(figure.curves.len());
    if !figure.fits.is_empty() {
        area.draw(&PathElement::new([(4, y), (26, y)], BLACK.mix(0.5)))?;
        area.draw(&text("thin: fitted", y))?;
        y = place(figure.curves.len() + 1);
    }
    if !figure.front.is_empty() {
        area.draw(&Circle::new((15, y), RING, BLACK.stroke_width(1)))?;
        area.draw(&text("nothing beats it", y))?;
    }
    Ok(())
}

/// All of the circle of hues, in equal steps.
fn color(curve: usize, figure: &Figure) -> HSLColor {
    HSLColor(curve as f64 / figure.curves.len() as f64, 0.8, 0.4)
}

/// An axis and what is written at its steps.
type Axis<'a, A> = (A, Box<dyn Fn(&f64) -> String + 'a>);

/// Equal factors from one number to another. Where there are many steps, only 1, 2 and 5 times a
/// power of ten are written, since the others would stand in each other.
fn factors<'a>(from: f64, to: f64) -> Axis<'a, LogCoord<f64>> {
    let few = to / from < 4.0;
    let is_round = |x: f64| ["1", "2", "5"].iter().any(|digit| format!("{x:.0e}").starts_with(digit));
    let write = move |x: &f64| if few || is_round(*x) { number(*x) } else { String::new() };
    ((from..to).log_scale().into(), Box::new(write))
}

/// A number at an axis: k for thousands, M for millions, without the rounding errors of its steps.
fn number(x: f64) -> String {
    match x.abs() {
        size if size >= 1e6 => format!("{} M", trimmed(x / 1e6)),
        size if size >= 1e4 => format!("{} k", trimmed(x / 1e3)),
        size if size > 0.0 && size < 1e-4 => format!("{x:.0e}"),
        _ => trimmed(x),
    }
}

fn trimmed(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Better;

    #[test]
    fn all_that_a_figure_holds_is_in_its_text() {
        let curve = |name: &str, y| Curve::new(name, [(1e3, y), (1e6, 2.0 * y)]);
        let mut figure = Figure::new("costs", "triangles", "ns", vec![curve("red", 1.0), curve("blue", 2.0)]);
        let plain = svg(&figure).unwrap();
        figure.fits = vec![curve("", 1.5)];
        figure = figure.with_front(Better::Less);
        let text = svg(&Figure { upward: Upward::Linear, ..figure.clone() }).unwrap();
        let words = ["costs", "triangles", "ns", "red", "blue", "100 k", "1 M", "nothing beats it"];
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
        assert!(text.matches("<polyline").count() >= 2 && text.trim_end().ends_with("</svg>"));
        assert_eq!(figure.front, [(1e3, 1.0)]);
        let circles = |text: &str| text.matches("<circle").count();
        assert_eq!((circles(&plain), circles(&text)), (4 + 2, 4 + 2 + 2));
        assert!(text.contains("thin: fitted") && !plain.contains("thin: fitted"));
    }

    #[test]
    fn what_has_no_place_is_left_out_and_told() {
        let figure =
            |points: &[(f64, f64)]| Figure::new("it", "", "", vec![Curve::new("", points.iter().copied())]);
        for point in [(0.0, 1.0), (1.0, 0.0), (1.0, f64::NAN), (f64::INFINITY, 1.0)] {
            let text = svg(&figure(&[point, (2.0, 3.0)])).unwrap();
            assert!(text.contains("but for 1 points"), "{point:?}");
            assert!(svg(&figure(&[point])).is_err(), "{point:?}");
        }
        let text = svg(&figure(&[(3.0, 1e-9)])).unwrap();
        assert!(!text.contains("but for"));
        assert!(svg(&Figure { upward: Upward::Linear, ..figure(&[(1.0, 0.0), (1.0, 1.0)]) }).is_ok());
    }

    #[test]
    fn numbers_at_axes_are_short() {
        let shown = [0.009000000000000001, 1.0, 0.1, 20.0, 1500.0, 2e4, 3e6, 1e-5, 0.0].map(number);
        let write = |from, to| factors(from, to).1;
        assert_eq!([20.0, 30.0, 50.0].map(|x| write(1.0, 100.0)(&x)), ["20", "", "50"]);
        assert_eq!(write(25.0, 35.0)(&30.0), "30");
        assert_eq!(shown, ["0.009", "1", "0.1", "20", "1500", "20 k", "3 M", "1e-5", "0"]);
    }
}

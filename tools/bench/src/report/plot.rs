//! Figures as SVG: the door to plotters.

use super::{Curve, Figure, Upward};
use common::cli::AppError;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;

/// Family and size of all text but the caption.
const FONT: (&str, u32) = ("sans-serif", 17);
/// Width and height in pixels.
const SIZE: (u32, u32) = (900, 560);
/// Radius of the rings around points of the front.
const RING: i32 = 7;

/// The text of a figure.
///
/// # Errors
/// If there is no point, or one that the axes have no place for.
pub fn svg(figure: &Figure) -> Result<String, AppError> {
    let points = || figure.curves.iter().flat_map(|c| c.points.iter());
    let range = |of: fn(&(f64, f64)) -> f64| {
        points().map(of).fold((f64::INFINITY, 0.0f64), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let ((min, max), (bottom, top)) = (range(|p| p.0), range(|p| p.1));
    let placeless = |(x, y): &(f64, f64)| {
        let least = if figure.upward == Upward::Linear { -f64::MIN_POSITIVE } else { 0.0 };
        !(x.is_finite() && y.is_finite() && *x > 0.0 && *y > least)
    };
    if min > max || points().any(placeless) {
        return Err(AppError::CheckFailed(format!("`{}`: nothing that can be drawn", figure.title)));
    }
    let mut text = String::new();
    let across = (min / 1.1..max * 1.1).log_scale();
    match figure.upward {
        Upward::Linear => picture(&mut text, figure, (across, 0.0..top * 1.05)),
        Upward::Logarithmic => {
            let up = (bottom / 1.2..top * 1.2).log_scale();
            picture(&mut text, figure, (across, up))
        }
    }
    .map_err(|e| AppError::CheckFailed(format!("cannot draw `{}`: {e}", figure.title)))?;
    Ok(text)
}

fn picture<X, Y>(
    text: &mut String,
    figure: &Figure,
    (across, up): (X, Y),
) -> Result<(), Box<dyn std::error::Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(&figure.title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(50)
        .y_label_area_size(75)
        .build_cartesian_2d(across, up)?;
    chart
        .configure_mesh()
        .x_desc(&figure.across)
        .y_desc(&figure.up)
        .label_style(FONT)
        .axis_desc_style(FONT)
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&|y| number(*y))
        .light_line_style(WHITE)
        .draw()?;
    for (i, curve) in figure.curves.iter().enumerate() {
        let color = color(i, figure);
        let line = chart.draw_series(LineSeries::new(curve.points.iter().copied(), color.stroke_width(2)))?;
        let sample = move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color.stroke_width(2));
        line.label(&curve.name).legend(sample);
        chart.draw_series(curve.points.iter().map(|p| Circle::new(*p, 3, color.filled())))?;
    }
    for (i, Curve { points, .. }) in figure.fits.iter().enumerate() {
        chart.draw_series(DashedLineSeries::new(points.iter().copied(), 6, 5, color(i, figure).into()))?;
    }
    if !figure.front.is_empty() {
        let ring = |p: &(f64, f64)| Circle::new(*p, RING, BLACK.stroke_width(1));
        let rings = chart.draw_series(figure.front.iter().map(ring))?;
        rings
            .label("nothing beats it")
            .legend(|(x, y)| Circle::new((x + 10, y), RING - 1, BLACK.stroke_width(1)));
    }
    let corner = match figure.upward {
        Upward::Linear => SeriesLabelPosition::UpperLeft,
        // Errors fall: what is free is the corner below.
        Upward::Logarithmic if falls(figure) => SeriesLabelPosition::LowerLeft,
        Upward::Logarithmic => SeriesLabelPosition::UpperLeft,
    };
    let mut legend = chart.configure_series_labels();
    legend.label_font(FONT).position(corner).background_style(WHITE).border_style(BLACK).draw()?;
    area.present()?;
    Ok(())
}

/// All of the circle of hues, in equal steps.
fn color(curve: usize, figure: &Figure) -> HSLColor {
    HSLColor(curve as f64 / figure.curves.len() as f64, 0.8, 0.4)
}

/// Whether most of the curves end lower than they begin.
fn falls(figure: &Figure) -> bool {
    let ends = figure.curves.iter().filter_map(|c| Some((c.points.first()?.1, c.points.last()?.1)));
    let (falling, rising) = ends.fold((0, 0), |(f, r), (a, b)| (f + i32::from(b < a), r + i32::from(b > a)));
    falling > rising
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
        assert_eq!((circles(&plain), circles(&text)), (4, 4 + 2));
        assert!(svg(&figure).unwrap().matches("<polyline").count() > plain.matches("<polyline").count());
    }

    #[test]
    fn what_has_no_place_is_refused() {
        let one = |point| svg(&Figure::new("", "", "", vec![Curve::new("", [point])]));
        assert!(one((1.0, 1.0)).is_ok());
        for point in [(0.0, 1.0), (1.0, 0.0), (1.0, f64::NAN), (f64::INFINITY, 1.0)] {
            assert!(one(point).is_err(), "{point:?}");
        }
        assert!(svg(&Figure::default()).is_err());
        assert!(one((3.0, 1e-9)).is_ok());
    }

    #[test]
    fn numbers_at_axes_are_short() {
        let shown = [0.009000000000000001, 1.0, 0.1, 20.0, 1500.0, 2e4, 3e6, 1e-5, 0.0].map(number);
        assert_eq!(shown, ["0.009", "1", "0.1", "20", "1500", "20 k", "3 M", "1e-5", "0"]);
    }
}

//! Pictures of curves, as SVG: the door to plotters.

use common::cli::AppError;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;
use std::path::Path;

/// Family and size of all text but the caption.
const FONT: (&str, u32) = ("sans-serif", 17);

/// One curve.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What it is called in the legend.
    pub name: String,
    /// x above zero.
    pub points: Vec<(f64, f64)>,
}

/// The upward axis; the other one is logarithmic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Upward {
    /// From 0, in equal steps.
    Linear,
    /// From the least value, in equal factors; all values above zero.
    Logarithmic,
}

/// Draws curves, under a title and with words for both axes.
///
/// # Errors
/// If there is no point, or the file cannot be written.
pub fn draw(file: &Path, words: [&str; 3], upward: Upward, curves: &[Curve]) -> Result<(), AppError> {
    let points = || curves.iter().flat_map(|c| c.points.iter());
    let range = |of: fn(&(f64, f64)) -> f64| {
        points().map(of).fold((f64::INFINITY, 0.0f64), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let ((min, max), (bottom, top)) = (range(|p| p.0), range(|p| p.1));
    if min > max {
        return Err(AppError::Usage("there is nothing to draw".to_owned()));
    }
    let mut text = String::new();
    let across = (min..max * 1.1).log_scale();
    // Drawing into a string first: a failure leaves no half file.
    match upward {
        Upward::Linear => picture(&mut text, words, (across, 0.0..top * 1.05), upward, curves),
        Upward::Logarithmic => {
            let up = (bottom / 1.2..top * 1.2).log_scale();
            picture(&mut text, words, (across, up), upward, curves)
        }
    }
    .map_err(|e| AppError::CheckFailed(format!("cannot draw {}: {e}", file.display())))?;
    Ok(std::fs::write(file, text)?)
}

fn picture<X, Y>(
    text: &mut String,
    [title, x_label, y_label]: [&str; 3],
    (across, up): (X, Y),
    upward: Upward,
    curves: &[Curve],
) -> Result<(), Box<dyn std::error::Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let area = SVGBackend::with_string(text, (900, 560)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(50)
        .y_label_area_size(65)
        .build_cartesian_2d(across, up)?;
    chart
        .configure_mesh()
        .x_desc(x_label)
        .y_desc(y_label)
        .label_style(FONT)
        .axis_desc_style(FONT)
        .x_label_formatter(&|x| short(*x))
        .y_label_formatter(&|y| match upward {
            Upward::Linear => format!("{y:.0}"),
            Upward::Logarithmic => small(*y),
        })
        .light_line_style(WHITE)
        .draw()?;
    for (i, curve) in curves.iter().enumerate() {
        let color = HSLColor(i as f64 / curves.len() as f64, 0.8, 0.4);
        let line = chart.draw_series(LineSeries::new(curve.points.iter().copied(), color.stroke_width(2)))?;
        let sample = move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color.stroke_width(2));
        line.label(&curve.name).legend(sample);
        chart.draw_series(curve.points.iter().map(|p| Circle::new(*p, 3, color.filled())))?;
    }
    let corner = match upward {
        Upward::Linear => SeriesLabelPosition::UpperLeft,
        // Errors fall: what is free is the corner below.
        Upward::Logarithmic => SeriesLabelPosition::LowerLeft,
    };
    let mut legend = chart.configure_series_labels();
    legend.label_font(FONT).position(corner).background_style(WHITE).border_style(BLACK).draw()?;
    area.present()?;
    Ok(())
}

/// A count with k for thousands and M for millions.
fn short(x: f64) -> String {
    match x {
        x if x >= 1e6 => format!("{:.0} M", x / 1e6),
        x if x >= 1e3 => format!("{:.0} k", x / 1e3),
        x => format!("{x:.0}"),
    }
}

/// A small number without the rounding errors that steps of the axis have.
fn small(y: f64) -> String {
    let text = format!("{y:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_is_in_the_file() {
        let file = std::env::temp_dir().join(format!("raysteps-plot-{}.svg", std::process::id()));
        let curve = |name: &str, y| Curve { name: name.to_owned(), points: vec![(1e3, y), (1e6, 2.0 * y)] };
        draw(&file, ["costs", "triangles", "ns"], Upward::Linear, &[curve("red", 1.0), curve("blue", 2.0)])
            .unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert!(
            ["costs", "triangles", "ns", "red", "blue", "100 k", "1 M"]
                .iter()
                .all(|word| text.contains(word))
        );
        assert!(text.matches("<polyline").count() >= 2 && text.trim_end().ends_with("</svg>"));
        assert_eq!([0.009000000000000001, 1.0, 0.1, 20.0].map(small), ["0.009", "1", "0.1", "20"]);
        assert!(draw(&file, ["", "", ""], Upward::Linear, &[]).is_err() && !file.exists());
    }
}

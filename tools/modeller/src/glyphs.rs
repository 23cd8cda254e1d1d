//! Outlines of the characters of the logo, drawn for it: upright, of even weight, digits 850
//! units high.

use glam::DVec2;

/// A point, in units.
pub type Point = (i32, i32);

/// A stretch of an outline from where the last one ended.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// Straight to a point.
    Line(Point),
    /// A cubic Bézier curve by way of two control points.
    Curve(Point, Point, Point),
}

/// A closed outline: where it starts, and the pieces that lead back there.
#[derive(Clone, Copy, Debug)]
pub struct Contour {
    /// Where the first piece starts and the last one ends.
    pub start: Point,
    /// At least two.
    pub pieces: &'static [Piece],
}

/// A character: its outer contour first, then the contours of its holes.
pub type Glyph = &'static [Contour];

use Piece::{Curve, Line};

/// The six: a bowl with a hole, and a stem that ends in the air.
pub const SIX: Glyph = &[
    Contour {
        start: (236, 690),
        pieces: &[
            Curve((205, 790), (140, 850), (50, 850)),
            Curve((-150, 850), (-285, 690), (-285, 400)),
            Curve((-285, 140), (-180, 0), (0, 0)),
            Curve((165, 0), (285, 115), (285, 270)),
            Curve((285, 425), (170, 530), (30, 530)),
            Curve((-50, 530), (-105, 500), (-138, 455)),
            Curve((-125, 620), (-70, 715), (45, 715)),
            Curve((85, 715), (110, 700), (124, 660)),
            Line((236, 690)),
        ],
    },
    Contour {
        start: (5, 410),
        pieces: &[
            Curve((-75, 410), (-130, 350), (-130, 268)),
            Curve((-130, 185), (-75, 125), (5, 125)),
            Curve((85, 125), (140, 185), (140, 268)),
            Curve((140, 350), (85, 410), (5, 410)),
        ],
    },
];

/// The full stop.
pub const POINT: Glyph = &[Contour {
    start: (0, 85),
    pieces: &[
        Curve((0, 132), (38, 170), (85, 170)),
        Curve((132, 170), (170, 132), (170, 85)),
        Curve((170, 38), (132, 0), (85, 0)),
        Curve((38, 0), (0, 38), (0, 85)),
    ],
}];

/// The eight: two bowls that flow together at the waist.
pub const EIGHT: Glyph = &[
    Contour {
        start: (0, 850),
        pieces: &[
            Curve((-150, 850), (-255, 765), (-255, 640)),
            Curve((-255, 545), (-185, 515), (-185, 453)),
            Curve((-185, 395), (-285, 355), (-285, 240)),
            Curve((-285, 95), (-170, 0), (0, 0)),
            Curve((170, 0), (285, 95), (285, 240)),
            Curve((285, 355), (185, 395), (185, 453)),
            Curve((185, 515), (255, 545), (255, 640)),
            Curve((255, 765), (150, 850), (0, 850)),
        ],
    },
    Contour {
        start: (0, 740),
        pieces: &[
            Curve((70, 740), (120, 697), (120, 632)),
            Curve((120, 567), (70, 520), (0, 520)),
            Curve((-70, 520), (-120, 567), (-120, 632)),
            Curve((-120, 697), (-70, 740), (0, 740)),
        ],
    },
    Contour {
        start: (0, 395),
        pieces: &[
            Curve((85, 395), (145, 335), (145, 253)),
            Curve((145, 170), (85, 115), (0, 115)),
            Curve((-85, 115), (-145, 170), (-145, 253)),
            Curve((-145, 335), (-85, 395), (0, 395)),
        ],
    },
];

/// The three: two open bowls that meet in a short bar.
pub const THREE: Glyph = &[Contour {
    start: (-240, 665),
    pieces: &[
        Curve((-215, 780), (-125, 850), (0, 850)),
        Curve((150, 850), (255, 760), (255, 635)),
        Curve((255, 545), (205, 480), (130, 450)),
        Curve((225, 420), (285, 345), (285, 240)),
        Curve((285, 95), (165, 0), (5, 0)),
        Curve((-135, 0), (-245, 75), (-270, 200)),
        Line((-130, 230)),
        Curve((-115, 165), (-65, 125), (0, 125)),
        Curve((85, 125), (140, 175), (140, 250)),
        Curve((140, 335), (75, 385), (-15, 385)),
        Line((-75, 385)),
        Line((-75, 510)),
        Line((-20, 510)),
        Curve((60, 510), (112, 555), (112, 622)),
        Curve((112, 685), (65, 727), (0, 727)),
        Curve((-55, 727), (-95, 695), (-108, 640)),
        Line((-240, 665)),
    ],
}];

/// The seven: a bar and a slanting stem.
pub const SEVEN: Glyph = &[Contour {
    start: (-270, 850),
    pieces: &[
        Line((270, 850)),
        Line((270, 735)),
        Line((-15, 0)),
        Line((-175, 0)),
        Line((105, 718)),
        Line((-270, 718)),
        Line((-270, 850)),
    ],
}];

/// A point as a vector.
pub fn vector((x, y): Point) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

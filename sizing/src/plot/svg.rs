//! From the library's scene to compact SVG that the page can scale.

use super::{HEIGHT, WIDTH};
use kuva::prelude::SvgBackend;
use kuva::render::render::{PathData, Primitive, Scene};

/// Crops the scene to the common height and writes it.
pub(super) fn finish(mut scene: Scene) -> String {
    scene.height = HEIGHT;
    scene.elements.iter_mut().for_each(compact);
    responsive(&SvgBackend::new().render_scene(&scene), WIDTH, HEIGHT)
}

/// Writes a drawing in its own size.
pub(super) fn finish_drawing(scene: &Scene) -> String {
    responsive(
        &SvgBackend::new().render_scene(scene),
        scene.width,
        scene.height,
    )
}

/// Lets the page decide the size, which the library can only fix; rounds the corners of lines.
fn responsive(svg: &str, width: f64, height: f64) -> String {
    let fixed = format!("width=\"{width}\" height=\"{height}\"");
    let free = format!("viewBox=\"0 0 {width} {height}\" preserveAspectRatio=\"xMidYMid meet\"");
    let round = "stroke-linejoin=\"round\" stroke-linecap=\"round\"";
    svg.replacen(&fixed, &format!("{free} {round}"), 1)
}

/// Writes lines and clouds of circles as paths of some 12 bytes per point, where the library would
/// spend 25 and 80. Coordinates are rounded to 0.1 px and repeated points left out, which no eye
/// sees at a line width of 1.8 px; a circle becomes the round cap of a stroke without length.
fn compact(primitive: &mut Primitive) {
    let (points, dots, look) = match primitive {
        Primitive::PolyLine {
            points,
            stroke,
            stroke_width,
            stroke_dasharray,
        } => {
            let look = (stroke.clone(), *stroke_width, stroke_dasharray.take());
            (std::mem::take(points), false, look)
        }
        Primitive::CircleBatch {
            cx, cy, r, fill, ..
        } => {
            let points = cx.iter().copied().zip(cy.iter().copied());
            (points.collect(), true, (fill.clone(), 2.0 * *r, None))
        }
        _ => return,
    };
    let mut written: Vec<String> = points
        .iter()
        .map(|(x, y)| format!("{x:.1} {y:.1}"))
        .collect();
    written.dedup();
    let d = if dots {
        format!("M{}h0", written.join("h0M"))
    } else {
        format!("M{}", written.join("L"))
    };
    let (stroke, stroke_width, stroke_dasharray) = look;
    let (fill, opacity) = (None, None);
    let path = PathData {
        d,
        fill,
        stroke,
        stroke_width,
        opacity,
        stroke_dasharray,
    };
    *primitive = Primitive::Path(Box::new(path));
}

//! Inline SVG that the page can scale, element by element.

use std::fmt::Write as _;

/// Anchor of a text.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Style of a line or an area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ink<'a> {
    /// Colour of the line.
    pub(crate) stroke: &'a str,
    /// Width of the line (px).
    pub(crate) width: f64,
    /// Fill colour; `None`: no fill.
    pub(crate) fill: Option<&'a str>,
    /// Opacity of the area, 0 to 1.
    pub(crate) opacity: f64,
    /// Dashes; empty: solid.
    pub(crate) dashes: &'a [u32],
}

impl<'a> Ink<'a> {
    /// A solid line.
    pub(crate) const fn line(stroke: &'a str, width: f64) -> Self {
        Self {
            stroke,
            width,
            fill: None,
            opacity: 1.0,
            dashes: &[],
        }
    }

    /// The same with a filled area.
    pub(crate) const fn filled(self, fill: &'a str) -> Self {
        Self {
            fill: Some(fill),
            ..self
        }
    }

    /// The same with a translucent area.
    pub(crate) const fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The same with dashes.
    pub(crate) const fn dashed(self, dashes: &'a [u32]) -> Self {
        Self { dashes, ..self }
    }
}

/// A sheet to draw on, in pixels, y down.
pub(crate) struct Svg {
    text: String,
}

impl Svg {
    /// A white sheet. A tall one gets more height on paper, so that its letters are as large as those of others.
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let class = if height > 0.5 * width {
            "class=\"tall\" "
        } else {
            ""
        };
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" {class}viewBox=\"0 0 {} {}\" preserveAspectRatio=\"xMidYMid meet\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\" \
             font-family=\"Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif\">\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>",
            px(width),
            px(height)
        );
        Self { text }
    }

    /// Opens a group with the title `title` and attributes, which contain no user text.
    pub(crate) fn open(&mut self, attributes: &str, title: &str) {
        self.push(&format!("<g {attributes}>"));
        if !title.is_empty() {
            self.push(&format!("<title>{}</title>", escaped(title)));
        }
    }

    /// Closes the last group.
    pub(crate) fn close(&mut self) {
        self.push("</g>");
    }

    /// A straight line with the ink of its group.
    pub(crate) fn rule(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        let [x1, y1, x2, y2] = [x1, y1, x2, y2].map(px);
        self.push(&format!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>"
        ));
    }

    /// Straight lines from point to point.
    pub(crate) fn path(&mut self, points: &[[f64; 2]], closed: bool, ink: &Ink) {
        let mut written: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{} {}", px(*x), px(*y)))
            .collect();
        written.dedup();
        let end = if closed { "Z" } else { "" };
        self.drawn_path(&format!("M{}{end}", written.join("L")), ink);
    }

    /// Dots of one size, each the round cap of a stroke of zero length: about 12 bytes each.
    pub(crate) fn dots(&mut self, points: &[[f64; 2]], colour: &str, diameter: f64) {
        let mut written: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{:.1} {:.1}", x + 0.0, y + 0.0))
            .collect();
        written.dedup();
        self.drawn_path(
            &format!("M{}h0", written.join("h0M")),
            &Ink::line(colour, diameter),
        );
    }

    fn drawn_path(&mut self, d: &str, ink: &Ink) {
        self.push(&format!(
            "<path d=\"{d}\" fill=\"{}\"",
            ink.fill.unwrap_or("none")
        ));
        self.ink(ink);
        if ink.opacity < 1.0 {
            self.push(&format!(" opacity=\"{}\"", ink.opacity));
        }
        self.push("/>");
    }

    /// A circle.
    pub(crate) fn circle(&mut self, centre: [f64; 2], radius: f64, ink: &Ink) {
        let [x, y, r] = [centre[0], centre[1], radius].map(px);
        let fill = ink.fill.unwrap_or("none");
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\""
        ));
        self.ink(ink);
        if ink.opacity < 1.0 {
            self.push(&format!(" fill-opacity=\"{}\"", ink.opacity));
        }
        self.push("/>");
    }

    fn ink(&mut self, ink: &Ink) {
        self.push(&format!(
            " stroke=\"{}\" stroke-width=\"{}\"",
            ink.stroke,
            px(ink.width)
        ));
        self.push(&dash_array(ink.dashes));
    }

    /// A text; `look` are further attributes, without user text.
    pub(crate) fn text(&mut self, at: [f64; 2], anchor: Anchor, look: &str, words: &str) {
        let [x, y] = at.map(px);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" {look}>{}</text>",
            escaped(words)
        ));
    }

    /// The whole element.
    pub(crate) fn finish(mut self) -> String {
        self.push("</svg>");
        self.text
    }

    fn push(&mut self, part: &str) {
        // Writing into a string cannot fail.
        let _ = self.text.write_str(part);
    }
}

/// A length to a hundredth of a pixel, without trailing zeros.
fn px(x: f64) -> String {
    let text = format!("{:.2}", x + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    (if text == "-0" { "0" } else { text }).to_owned()
}

/// User text with markup escaped and characters removed that XML does not allow.
fn escaped(raw: &str) -> String {
    let mut text = String::with_capacity(raw.len());
    for c in raw.chars() {
        match c {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            '\'' => text.push_str("&apos;"),
            '\u{FFFE}' | '\u{FFFF}' => text.push(' '),
            c if c.is_control() => text.push(' '),
            c => text.push(c),
        }
    }
    text
}

/// The attribute for dashes and gaps of these lengths (px); empty for a solid line.
pub(crate) fn dash_array(lengths: &[u32]) -> String {
    if lengths.is_empty() {
        return String::new();
    }
    let lengths: Vec<String> = lengths.iter().map(u32::to_string).collect();
    format!(" stroke-dasharray=\"{}\"", lengths.join(" "))
}

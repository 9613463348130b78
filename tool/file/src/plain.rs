//! Texts without hidden characters. Characters that are invisible, or that change the display order, are refused where names and titles are read, and
//! escaped where a path or an argument is printed.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::path::Path;

/// Whether a character is invisible or changes the display of others: a control character, an end of line or paragraph, a mark of the writing
/// direction, a space without width, a byte order mark, a filler, a variation selector, a tag. These are Unicode's `Default_Ignorable_Code_Point`,
/// the marks of annotations and the empty Braille pattern.
pub fn is_hidden(c: char) -> bool {
    // Fast path for ASCII, in results of a hundred megabytes.
    !(' '..='~').contains(&c)
        && (c.is_control()
            || matches!(
                c,
                '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
                    | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
                    | '\u{2060}'..='\u{206f}' | '\u{2800}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}'
                    | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}' | '\u{1bca0}'..='\u{1bca3}'
                    | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}'
            ))
}

/// The first hidden character of a text.
pub fn hidden(text: &str) -> Option<char> {
    // Fast path: names are nearly always ASCII.
    if text.bytes().all(|b| (b' '..=b'~').contains(&b)) {
        return None;
    }
    text.chars().find(|c| is_hidden(*c))
}

/// Description of a hidden character, with its code: `U+000D, a control character`.
pub fn described(c: char) -> String {
    let kind = match c {
        '\n' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}' => "an end of line",
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            "a mark of the direction of writing"
        }
        c if c.is_control() => "a control character",
        _ => "a character that is not seen",
    };
    format!("U+{:04X}, {kind}", u32::from(c))
}

/// Cure for a hidden character.
pub const CURE: &str =
    "remove it: names, titles and other texts are one line of characters that can be seen";

/// A text in which every hidden character except ends of lines and tabs is replaced by a visible one of equal length in bytes, so that positions in
/// it stay valid.
pub fn masked(text: &str) -> Cow<'_, str> {
    let is_end = |rest: &str| rest.starts_with(['\n', '\t']) || rest.starts_with("\r\n");
    let mask = |(at, c): (usize, char)| {
        if !is_hidden(c) || is_end(text.get(at..).unwrap_or_default()) {
            return c;
        }
        match c.len_utf8() {
            1 => '?',
            2 => '¿',
            3 => char::REPLACEMENT_CHARACTER,
            _ => '\u{1fbc4}', // a question mark, in white on black
        }
    };
    if text.char_indices().all(|(at, c)| mask((at, c)) == c) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.char_indices().map(mask).collect())
}

/// A text on one line, its hidden characters as `\u000d`.
pub fn escaped(text: &str) -> Cow<'_, str> {
    without(text, is_hidden)
}

/// A text of several lines, with tabs; other hidden characters as `\u000d`, beyond U+FFFF as two such surrogates, which JSON reads as that character.
pub fn lines(text: &str) -> Cow<'_, str> {
    without(text, |c| is_hidden(c) && !matches!(c, '\n' | '\t'))
}

fn without(text: &str, is_hidden: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        if is_hidden(c) {
            for half in c.encode_utf16(&mut [0; 2]) {
                let _ = write!(safe, "\\u{half:04x}");
            }
        } else {
            safe.push(c);
        }
    }
    Cow::Owned(safe)
}

/// A path for display.
#[expect(
    clippy::disallowed_methods,
    reason = "the one place where a path becomes a text"
)]
pub fn path(path: impl AsRef<Path>) -> String {
    escaped(&path.as_ref().display().to_string()).into_owned()
}

/// Most characters of a value in a message.
const MOST: usize = 60;

/// Whether a message shows all of a value.
pub fn is_short(value: &str) -> bool {
    value.len() <= MOST || value.chars().nth(MOST).is_none()
}

/// A value for a message: on one line, a long one truncated.
pub fn cut(value: &str) -> String {
    let value = escaped(value);
    match value.char_indices().nth(MOST) {
        Some((at, _)) => format!("{}…", value.get(..at).unwrap_or_default()),
        None => value.into_owned(),
    }
}

/// The same in quotes.
pub fn quoted(value: &str) -> String {
    format!("\"{}\"", cut(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_found() {
        for c in "\0\t\n\r\u{7f}\u{85}\u{61c}\u{200b}\u{200e}\u{200f}\u{2028}\u{2029}\u{202a}\u{202e}\u{2060}\u{2066}\u{2069}\u{feff}\
                  \u{ad}\u{34f}\u{115f}\u{1160}\u{17b4}\u{17b5}\u{180b}\u{180f}\u{2800}\u{3164}\u{fe00}\u{fe0f}\u{ffa0}\
                  \u{fff9}\u{fffb}\u{1bca0}\u{1d173}\u{e0000}\u{e0041}\u{e0fff}"
            .chars()
        {
            assert_eq!(hidden(&format!("è{c}")), Some(c), "{}", described(c));
        }
        assert_eq!(hidden("Presse Süd, 5 µm · φ′ – 電動機"), None);
    }

    #[test]
    fn what_is_printed_shows_them() {
        assert_eq!(escaped("a\r\nb\u{202e}"), "a\\u000d\\u000ab\\u202e");
        assert_eq!(lines("a\tb\nc\u{1b}[31m"), "a\tb\nc\\u001b[31m");
        assert_eq!(path("out\n.csv"), "out\\u000a.csv");
        assert_eq!(escaped("\u{ad}\u{e0041}"), "\\u00ad\\udb40\\udc41");
        for text in ["x\u{202e}", "\u{e0041}y"] {
            let json = format!("\"{}\"", lines(text));
            assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text);
        }
    }

    #[test]
    fn places_stay_where_characters_are_masked() {
        let text = "a\r\n\tb\rc\u{85}d\u{202e}e\u{1b}f\u{ad}\u{e0041}\n";
        let shown = masked(text);
        assert_eq!(shown, "a\r\n\tb?c¿d\u{fffd}e?f¿\u{1fbc4}\n");
        assert_eq!(shown.len(), text.len());
        assert!(matches!(masked("µ\r\n"), Cow::Borrowed(_)));
    }

    #[test]
    fn long_values_are_cut() {
        assert_eq!(cut(&"x".repeat(60)), "x".repeat(60));
        assert_eq!(cut(&"é".repeat(61)), format!("{}…", "é".repeat(60)));
    }
}

//! The paper that a page is printed on.

jred_file::words! {
    /// Paper of a page.
    pub enum Paper default A4 {
        /// 210 mm × 297 mm.
        A4 = "a4",
        /// US letter, 8.5 in × 11 in.
        Letter = "letter",
    }
}

impl Paper {
    /// The page, whose style sheet is for A4, on this paper.
    #[must_use]
    pub fn page(self, page: String) -> String {
        const LETTER: &str = "<style>@page { size: letter; } @page broad { size: letter landscape; }</style>\n</head>";
        match self {
            Self::A4 => page,
            // No title contains it: "<" is escaped.
            Self::Letter => page.replacen("</head>", LETTER, 1),
        }
    }
}

/// A text for a string of a style sheet inside HTML, where every letter is a code: none of them ends the string or the sheet.
pub(crate) fn in_quotes(text: &str) -> String {
    let code = |c: char| format!("\\{:x} ", u32::from(c));
    text.chars().map(code).collect()
}

//! Values that a command line names by a word, with their meanings defined beside them; counts with their nouns.

/// A value with its word.
pub trait Word: Copy + Send + Sync + 'static {
    /// All values: the value, its word, its meaning.
    const WORDS: &'static [(Self, &'static str, &'static str)];

    /// The value of a word.
    fn of_word(word: &str) -> Option<Self> {
        let known = Self::WORDS.iter().find(|(_, own, _)| *own == word);
        known.map(|(value, ..)| *value)
    }
}

/// A count with its noun: `1 drive`, `3 drives`.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    let noun = if count == 1 { one } else { many };
    format!("{count} {noun}")
}

/// An enum whose variants have words: `Variant = "word"`. The doc comments are its meanings.
#[macro_export]
macro_rules! words {
    ($(#[$meta:meta])* pub enum $name:ident $(default $default:ident)? {
        $($(#[doc = $doc:literal])+ $variant:ident = $word:literal,)+
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[doc = $doc])+ $variant,)+
        }

        impl $name {
            /// Its word.
            pub const fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }

        impl $crate::number::words::Word for $name {
            const WORDS: &'static [(Self, &'static str, &'static str)] =
                &[$((Self::$variant, $word, concat!($($doc),+))),+];
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }

        $(impl Default for $name {
            fn default() -> Self {
                Self::$default
            }
        })?
    };
}

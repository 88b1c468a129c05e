//! What is said of a number, as a word that a program can decide by.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Words with one spelling on disk and for people.
macro_rules! words {
    ($(#[$about:meta])* $name:ident { $($(#[$one:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$one])* #[serde(rename = $word)] $variant,)+
        }

        impl $name {
            /// The word on disk and for people.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}

words! {
    /// Why a row has no numbers somewhere.
    Status {
        /// Not run: its inputs are missing, or it does not apply.
        Skipped = "skipped",
        /// Ran and ended in an error.
        Failed = "failed",
    }
}

words! {
    /// Our ratio of two errors beside the one that the source work reports.
    Agreement {
        /// Our interval meets the source's range, and not 1 as well where that does not.
        Agrees = "agrees",
        /// Below the source's range, which is not above 1.
        LargerGain = "larger gain than the paper's",
        /// Above the source's range, and not above 1.
        SmallerGain = "smaller gain than the paper's",
        /// Above the source's range, which is not below 1.
        LargerLoss = "larger loss than the paper's",
        /// Below the source's range, and not below 1.
        SmallerLoss = "smaller loss than the paper's",
        /// Our interval and the source's range are on different sides of 1.
        Opposite = "opposite sign",
        /// There is no interval, or it cannot tell the effect from none.
        Undecided = "undecided",
        /// There is no ratio.
        NoNumber = "no number",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_the_same_on_disk_and_for_people() {
        for word in [Agreement::LargerGain, Agreement::Undecided] {
            let on_disk = serde_json::to_string(&word).unwrap();
            assert_eq!(on_disk, format!("\"{word}\""));
            assert_eq!(serde_json::from_str::<Agreement>(&on_disk).unwrap(), word);
        }
        assert!(serde_json::from_str::<Status>("\"lost\"").is_err());
    }
}

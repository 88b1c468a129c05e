//! Results and messages: standard output is checked, standard error is best effort.
//!
//! A reader that closes the pipe has seen enough: what follows is dropped and the work goes on. Anything else that
//! keeps results from standard output, such as a full disk behind it, is an error. `println!` panics on both.

use std::fmt::{Arguments, Display};
use std::io::{self, ErrorKind, Write};

use anyhow::bail;

/// Where a verb's messages go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Out {
    /// Standard output.
    Stdout,
    /// Standard error, because standard output carries an image.
    Stderr,
}

impl Out {
    /// Writes text as it is.
    ///
    /// # Errors
    /// If standard output cannot take it, unless its reader is gone.
    pub fn text(self, text: impl Display) -> anyhow::Result<()> {
        match self {
            Self::Stdout => checked(&mut io::stdout().lock(), format_args!("{text}")),
            Self::Stderr => {
                let _ = write!(io::stderr().lock(), "{text}");
                Ok(())
            }
        }
    }
}

/// Writes and flushes; a reader that is gone is no error.
fn checked(to: &mut impl Write, text: Arguments<'_>) -> anyhow::Result<()> {
    match to.write_fmt(text).and_then(|()| to.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            bail!("cannot write to standard output: {error}")
        }
        _ => Ok(()),
    }
}

/// `println!` to an [`Out`], with the error as a result.
macro_rules! say {
    ($out:expr) => { $out.text("\n") };
    ($out:expr, $($text:tt)*) => { $out.text(format_args!("{}\n", format_args!($($text)*))) };
}

/// `eprintln!` that does not panic where standard error is closed or full.
macro_rules! note {
    ($($text:tt)*) => {
        // Nobody is left to be told.
        drop($crate::out::Out::Stderr.text(format_args!("{}\n", format_args!($($text)*))))
    };
}

pub(crate) use {note, say};

#[cfg(test)]
mod tests {
    use super::*;

    /// A stream in a state.
    struct Broken(ErrorKind);

    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_reader_that_is_gone_is_no_error_but_a_full_disk_is() {
        assert!(checked(&mut Broken(ErrorKind::BrokenPipe), format_args!("x")).is_ok());
        let error = checked(&mut Broken(ErrorKind::StorageFull), format_args!("x")).unwrap_err();
        assert!(error.to_string().contains("standard output"), "{error}");
        let mut kept = Vec::new();
        checked(&mut kept, format_args!("{}", 1)).unwrap();
        assert_eq!(kept, b"1");
    }
}

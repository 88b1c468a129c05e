//! Where the values of a sample lie: the colour, then what is recorded.

use crate::table::{Joined, Row, TABLE, Taken};
use crate::tally::LANES;
use crate::{Keep, Quantity};

/// Values of the colour, which come first.
pub const COLOR: usize = 3;

/// A recorded quantity.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// What it is.
    pub row: &'static Row,
    /// What is kept of it.
    pub keep: Keep,
    /// Its first value.
    pub first: usize,
    /// Planes of its mean; of each of the two means of a pair.
    pub channels: usize,
}

impl Column {
    /// Values that a sample has of it.
    fn values(&self) -> usize {
        match self.row.joined {
            Joined::Mean | Joined::First => self.channels,
            Joined::Ratio => 2,
            Joined::Pair => 3 * self.channels,
        }
    }
}

/// The recorded quantities.
#[derive(Debug, Clone)]
pub struct Columns {
    /// In the order of [`Quantity`].
    pub list: Vec<Column>,
    /// Values of a sample that are accumulated, rounded up to whole lanes.
    pub accumulated: usize,
    /// Those and the ones of which the first sample's are kept.
    pub all: usize,
}

impl Columns {
    /// Of these quantities.
    pub fn new(kept: &[(Quantity, Keep)]) -> Self {
        let column = |(quantity, keep): &(Quantity, Keep)| {
            let channels = quantity.feature().and_then(|id| id.channel_names()).map_or(3, <[_]>::len);
            Column { row: &TABLE[*quantity as usize], keep: *keep, first: 0, channels }
        };
        let mut list: Vec<Column> = kept.iter().map(column).collect();
        let mut end = COLOR;
        let mut place = |column: &mut Column| {
            column.first = end;
            end += column.values();
            end
        };
        let accumulated = list.iter_mut().filter(|c| c.row.joined != Joined::First).map(&mut place).last();
        let accumulated = accumulated.unwrap_or(COLOR).next_multiple_of(LANES);
        end = accumulated;
        for column in list.iter_mut().filter(|c| c.row.joined == Joined::First) {
            column.first = end;
            end += column.values();
        }
        Self { list, accumulated, all: end }
    }

    /// The first value of what is taken in this way, if it is recorded.
    pub fn first_of(&self, is: impl Fn(&Taken) -> bool) -> Option<usize> {
        self.list.iter().find(|column| is(&column.row.taken)).map(|column| column.first)
    }
}

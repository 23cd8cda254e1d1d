//! How much is tried.

/// How long a survey may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// Seconds: part of the test command.
    Quick,
    /// Minutes: the numbers of `accuracy.md`.
    Full,
    /// On demand: ten times as much wherever chance plays a part.
    Long,
}

impl Tier {
    /// Every tier.
    pub const ALL: [Self; 3] = [Self::Quick, Self::Full, Self::Long];

    /// Its name on command lines and in reproducers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Full => "full",
            Self::Long => "long",
        }
    }

    /// Whether more is asked than the test command has time for.
    pub fn is_thorough(self) -> bool {
        self != Self::Quick
    }
}

/// Numbers of trials. A plain number is that of the quick tier, the full one does ten times as
/// many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trials {
    /// In the quick tier.
    pub quick: u64,
    /// In the full tier; the long one does ten times as many.
    pub full: u64,
}

impl From<u64> for Trials {
    fn from(quick: u64) -> Self {
        Self { quick, full: 10 * quick }
    }
}

impl Trials {
    /// Different numbers for the two tiers.
    pub fn new(quick: u64, full: u64) -> Self {
        Self { quick, full }
    }

    /// The number of a tier.
    pub fn at(self, tier: Tier) -> u64 {
        match tier {
            Tier::Quick => self.quick,
            Tier::Full => self.full,
            Tier::Long => 10 * self.full,
        }
    }
}

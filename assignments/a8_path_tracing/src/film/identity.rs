//! What a rendering is a rendering of: parts belong together only if this is the same.

/// All that decides the value of a sample, by name: flags and a number for the scene. Names and
/// values are shown to users.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Identity {
    /// Names and values, always in the same order.
    pub facts: Vec<(String, String)>,
}

impl Identity {
    /// Adds a fact.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl ToString) -> Self {
        self.facts.push((name.to_owned(), value.to_string()));
        self
    }

    /// The first fact that another identity says differently: its name, what is said here, and
    /// what there; `none` for what is not said at all.
    pub fn difference<'a>(&'a self, other: &'a Self) -> Option<[&'a str; 3]> {
        const MISSING: &str = "none";
        let said = |of: &'a Self, name: &str| {
            of.facts.iter().find(|(other, _)| other == name).map_or(MISSING, |(_, value)| value)
        };
        let names = self.facts.iter().chain(&other.facts).map(|(name, _)| name.as_str());
        names.map(|name| [name, said(self, name), said(other, name)]).find(|[_, here, there]| here != there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_difference_is_told() {
        let one = Identity::default().with("-seed", 3).with("-bounces", "no limit");
        assert_eq!(one.difference(&one.clone()), None);
        let other = Identity::default().with("-seed", 3).with("-bounces", 4);
        assert_eq!(one.difference(&other), Some(["-bounces", "no limit", "4"]));
        let less = Identity::default().with("-seed", 3);
        assert_eq!(one.difference(&less), Some(["-bounces", "no limit", "none"]));
        assert_eq!(less.difference(&one), Some(["-bounces", "none", "no limit"]));
    }
}

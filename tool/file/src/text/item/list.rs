//! Lists, pairs and tables of a value.

use toml::Spanned;
use toml::de::DeValue;

use super::Item;
use crate::number::words::counted;
use crate::text::key::{OPEN, ValueForm};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;
use crate::units::kind::Kind;

impl<'a> Item<'a> {
    /// The elements of a list; in messages each is called `word` with its number.
    pub(crate) fn list(&self, word: &str, example: &str) -> Result<Vec<Self>> {
        let DeValue::Array(array) = self.value.get_ref() else {
            return Err(self.wrong_type("a list", &format!("{} = {example}", self.key)));
        };
        let list = |form| match form {
            ValueForm::List(element, counts) => Some((*element, counts)),
            _ => None,
        };
        let described = self.form.and_then(|form| form.first(list));
        if let Some((_, [least, most])) = described
            && !(least..=most).contains(&array.len())
        {
            return Err(self.wrong_count(array.len(), [least, most], (word, example)));
        }
        let element = |(k, value): (usize, &'a Spanned<DeValue<'a>>)| {
            let name = format!("{word} {} of {}", k + 1, self.name);
            let element = described.map(|(element, _)| element);
            Self::new(name, self.key, value.span(), value).described(element, "", self.slides)
        };
        Ok(array.iter().enumerate().map(element).collect())
    }

    /// The two elements of a list.
    pub(crate) fn both(&self, word: &str, example: &str) -> Result<[Self; 2]> {
        let list = self.list(word, example)?;
        list.try_into()
            .map_err(|list: Vec<Self>| self.wrong_count(list.len(), [2, 2], (word, example)))
    }

    /// The problem of a list with too few or too many elements, each called `word`.
    fn wrong_count(
        &self,
        count: usize,
        counts: [usize; 2],
        (word, example): (&str, &str),
    ) -> Problem {
        let words = format!("{word}s");
        let counts = match counts {
            [2, 2] => format!("two {words}"),
            [least, usize::MAX] => format!("at least {}", counted(least, word, &words)),
            [least, most] => format!("{least} to {most} {words}"),
        };
        let problem = self.problem(&format!("must have {counts}, but has {count}"), "here");
        problem.help(format!("write {} = {example}", self.key))
    }

    /// Two quantities.
    pub(crate) fn pair(&self, kinds: [&'static Kind; 2]) -> Result<[Value; 2]> {
        let [first, second] = kinds;
        // Coordinates, or the ends of a range, of which the second is larger.
        let example = if std::ptr::eq(first, second) {
            format!("[\"0 {}\", \"{}\"]", first.unit, second.example)
        } else {
            format!("[\"{}\", \"{}\"]", first.example, second.example)
        };
        let [first, second] = self.both("value", &example)?;
        Ok([first.quantity(kinds[0])?, second.quantity(kinds[1])?])
    }

    /// A table, called `title` in messages.
    pub(crate) fn section(&self, title: String) -> Result<Section<'a>> {
        let DeValue::Table(table) = self.value.get_ref() else {
            let example = format!("a table: {title}, or {} = {{ … }}", self.key);
            return Err(self.wrong_type("a table", &example));
        };
        let keys = self.form.and_then(ValueForm::table).unwrap_or(&OPEN);
        let section = Section::described(title, self.span(), table, (keys, self.slides));
        section.not_both(keys)?;
        Ok(match self.form {
            Some(ValueForm::Named(entry)) => section.of_entries(*entry),
            _ => section,
        })
    }

    /// An array of tables; in messages each is called `title` with its number.
    ///
    /// # Errors
    /// The value is not an array of tables.
    pub fn sections(&self, title: &str) -> Result<Vec<Section<'a>>> {
        let DeValue::Array(array) = self.value.get_ref() else {
            let example = format!("the header in double brackets: {title}, once for each");
            return Err(self.wrong_type("a list of tables", &example));
        };
        let items = array.iter().enumerate();
        items
            .map(|(k, value)| {
                let name = format!("{title} number {}", k + 1);
                Self::new(name.clone(), self.key, value.span(), value)
                    .described(self.form, self.example, self.slides)
                    .section(name)
            })
            .collect()
    }
}

//! What a call is expected to cost, and whether a count still fits.

/// How far a count may be off with the compiler that the file names. Counts repeat to the instruction, but an edit elsewhere
/// can change what is inlined.
const SLACK: f64 = 0.03;

/// And with any other compiler, which may well inline in another way: only what grows beyond it fails.
const OTHER_COMPILER_SLACK: f64 = 0.15;

/// The command that writes the file anew.
pub(crate) const UPDATE: &str = "cargo bench -p maze-core --bench instructions --locked -- --update";

/// Instructions a call, by the call's name, and the compiler they were counted with.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Counts {
    pub(crate) compiler: String,
    pub(crate) calls: Vec<(String, f64)>,
}

impl Counts {
    /// Reads what [`Counts::to_text`] writes.
    pub(crate) fn from_text(text: &str) -> Result<Self, String> {
        let mut counts = Self::default();
        for (index, line) in text.lines().enumerate() {
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let expected = || format!("line {}: expected `name = instructions`", index + 1);
            let (name, value) = line.split_once(" = ").ok_or_else(expected)?;
            let (name, value) = (name.trim_end().to_owned(), value.trim());
            if name == "compiler" {
                value.clone_into(&mut counts.compiler);
            } else {
                let is_count = |count: &f64| count.is_finite() && 0.0 < *count;
                let count = value.parse().ok().filter(is_count).ok_or_else(expected)?;
                counts.calls.push((name, count));
            }
        }
        Ok(counts)
    }

    pub(crate) fn to_text(&self) -> String {
        let mut text = format!("# Instructions a call. Written by\n#   {UPDATE}\n");
        text += &format!("{:34} = {}\n", "compiler", self.compiler);
        for (name, count) in &self.calls {
            text += &format!("{name:34} = {count:.1}\n");
        }
        text
    }

    /// A line for each call, and whether it fits.
    ///
    /// `self` is what is expected. A fall fails too: unless the file follows, the next loss would hide in what was won.
    pub(crate) fn compare(&self, counted: &Self) -> Vec<(String, bool)> {
        let same = self.compiler == counted.compiler;
        let slack = if same { SLACK } else { OTHER_COMPILER_SLACK };
        let mut lines = Vec::new();
        for (name, count) in &counted.calls {
            let line = format!("{name:34} {count:9.1}");
            let Some((_, expected)) = self.calls.iter().find(|(known, _)| known == name) else {
                lines.push((format!("{line}  not in the file"), false));
                continue;
            };
            let change = count / expected - 1.0;
            let percent = if change.abs() < 0.0005 { 0.0 } else { 100.0 * change }; // not -0.0
            let (word, fits) = match () {
                () if slack < change => ("  SLOWER", false),
                () if change < -slack => ("  faster: the file has to follow", !same),
                () => ("", true),
            };
            lines.push((format!("{line}  {percent:+6.1} % of {expected:.1}{word}"), fits));
        }
        let is_gone = |name: &String| counted.calls.iter().all(|(known, _)| known != name);
        for (name, _) in self.calls.iter().filter(|(name, _)| is_gone(name)) {
            lines.push((format!("{name:34} in the file, but no longer counted"), false));
        }
        lines
    }

    /// How the comparison is made, in one line.
    pub(crate) fn terms(&self, counted: &Self) -> String {
        if self.compiler == counted.compiler {
            return format!("within {:.0} %, {}", 100.0 * SLACK, self.compiler);
        }
        format!(
            "expected with {}, counted with {}: at most {:.0} % more",
            self.compiler,
            counted.compiler,
            100.0 * OTHER_COMPILER_SLACK
        )
    }
}

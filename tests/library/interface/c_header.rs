//! `nearwall.h` as cbindgen writes it now, and its structs, functions and numbers.

use std::fmt::Write;
use std::path::Path;

use nearwall::c_api::INPUT_STRUCTS;
use nearwall::impact::INPUTS;

/// A field of a struct or an argument of a function.
pub struct Field {
    pub name: String,
    /// Number of entries of an array inside the struct: a number, or the name of one.
    pub length: Option<String>,
    /// Its C type without `struct`, for instance `const nw_impact *`.
    pub kind: String,
}

pub struct Struct {
    pub name: String,
    pub fields: Vec<Field>,
}

pub struct Function {
    pub name: String,
    pub result: String,
    pub arguments: Vec<Field>,
}

/// The interface that the header declares.
pub struct Header {
    /// The header itself.
    pub text: String,
    /// Name and C type.
    pub types: Vec<Field>,
    pub structs: Vec<Struct>,
    pub functions: Vec<Function>,
    /// Name and value.
    pub numbers: Vec<(String, String)>,
}

impl Header {
    /// The header of the source as it is now.
    pub fn generate() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
        config.after_includes = Some(inputs_macro());
        let folder = tempfile::tempdir().unwrap();
        let structs = folder.path().join("inputs.rs");
        std::fs::write(&structs, INPUT_STRUCTS).unwrap();
        let builder = cbindgen::Builder::new().with_config(config).with_src(root.join("src/c_api/mod.rs"));
        let mut text = Vec::new();
        builder.with_src(structs).generate().unwrap().write(&mut text);
        Self::parse(String::from_utf8(text).unwrap())
    }

    fn parse(text: String) -> Self {
        let mut header = Self {
            text: String::new(),
            types: Vec::new(),
            structs: Vec::new(),
            functions: Vec::new(),
            numbers: Vec::new(),
        };
        let lines = || text.lines().map(|line| line.split("//").next().unwrap());
        for words in lines().map(|line| line.split_whitespace().collect::<Vec<_>>()) {
            if let ["#define", name, value] = words[..]
                && !name.contains('(')
            {
                header.numbers.push((name.to_owned(), value.to_owned()));
            }
        }
        let is_code = |line: &&str| {
            !line.starts_with('#') && !line.trim().starts_with("X(") && !line.contains("extern \"C\"")
        };
        let mut code = lines().filter(is_code).collect::<Vec<_>>().join(" ");
        while let Some((before, rest)) = code.split_once("/*") {
            code = format!("{before}{}", rest.split_once("*/").unwrap().1);
        }
        let mut rest = code.as_str();
        while let Some(end) = rest.find([';', '{']) {
            let (statement, after) = (rest[..end].trim(), &rest[end + 1..]);
            rest = after;
            if statement.starts_with("typedef struct") && statement.split(' ').count() == 3 {
                let (body, after) = rest.split_once('}').unwrap();
                let fields = body.split(';').map(str::trim).filter(|field| !field.is_empty());
                header.structs.push(Struct {
                    name: statement.rsplit(' ').next().unwrap().to_owned(),
                    fields: fields.map(Field::parse).collect(),
                });
                rest = after.split_once(';').unwrap().1;
            } else if let Some(alias) = statement.strip_prefix("typedef ") {
                header.types.push(Field::parse(alias));
            } else if let Some((head, arguments)) =
                statement.strip_suffix(')').and_then(|s| s.split_once('('))
            {
                let Field { name, kind: result, .. } = Field::parse(head);
                let arguments = arguments.split(',').filter(|argument| *argument != "void");
                header.functions.push(Function {
                    name,
                    result,
                    arguments: arguments.map(Field::parse).collect(),
                });
            }
        }
        header.text = text;
        header
    }

    pub fn number(&self, name: &str) -> &str {
        &self.numbers.iter().find(|(other, _)| other == name).unwrap().1
    }
}

impl Field {
    fn parse(text: &str) -> Self {
        let text = text.split_whitespace().filter(|word| *word != "struct").collect::<Vec<_>>().join(" ");
        let end = text.rfind([' ', '*']).unwrap() + 1;
        let (name, length) = match text[end..].trim_end_matches(']').split_once('[') {
            Some((name, length)) => (name, Some(length.to_owned())),
            None => (&text[end..], None),
        };
        Self { name: name.to_owned(), length, kind: text[..end].trim().to_owned() }
    }
}

/// `NW_IMPACT_INPUTS`, for code that does the same with every input.
fn inputs_macro() -> String {
    let mut text =
        "\n// Applies a macro to the name of every input of `nw_impact`, in the order of its fields.\n\
                    #define NW_IMPACT_INPUTS(X)"
            .to_owned();
    for input in &INPUTS {
        write!(text, " \\\n  X({})", input.name).unwrap();
    }
    text
}

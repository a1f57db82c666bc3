//! The generated part of each binding, from the header.

use std::fmt::Write;

use nearwall::Impact;
use nearwall::impact::{INPUTS, Input};

use super::c_header::{Field, Function, Header, Struct};

/// Values of a C type in each language: Fortran, Python, Rust, and size in bytes.
fn value(kind: &str) -> [&'static str; 3] {
    match kind {
        "double" => ["real(c_double)", "c_double", "f64"],
        "int32_t" | "nw_status" => ["integer(c_int32_t)", "c_int32", "i32"],
        "uint32_t" | "nw_regime" => ["integer(c_int32_t)", "c_uint32", "u32"],
        "uint64_t" => ["integer(c_int64_t)", "c_uint64", "u64"],
        "size_t" => ["integer(c_size_t)", "c_size_t", "usize"],
        other => panic!("{other} has no equivalent yet"),
    }
}

/// What a pointer points to, and whether it may be written through.
fn target(kind: &str) -> Option<(&str, bool)> {
    let target = kind.strip_suffix('*')?.trim();
    Some((target.strip_prefix("const ").unwrap_or(target), !target.starts_with("const ")))
}

fn is_struct(header: &Header, kind: &str) -> bool {
    header.structs.iter().any(|one| one.name == kind)
}

/// `x, y, z` in lines of at most 110 characters that begin with `indent`.
fn wrapped(items: impl IntoIterator<Item = String>, indent: &str) -> String {
    let (mut text, mut line) = (String::new(), indent.to_owned());
    for item in items {
        if line.len() + item.len() > 108 {
            writeln!(text, "{}", line.trim_end()).unwrap();
            line = indent.to_owned();
        }
        write!(line, "{item}, ").unwrap();
    }
    text + line.trim_end().trim_end_matches(',')
}

// --- Fortran ---------------------------------------------------------------------------------------------------------

pub fn fortran(header: &Header) -> String {
    let mut text = String::new();
    for (name, value) in &header.numbers {
        // Fortran cannot tell NW_ABI_VERSION from the function of that name.
        let name = name.replace("NW_ABI", "NEARWALL_ABI");
        writeln!(text, "  integer(c_int32_t), parameter :: {name} = {value}").unwrap();
    }
    for one in &header.structs {
        text += &fortran_type(header, one);
    }
    text += "\n  interface\n";
    for function in &header.functions {
        text += &fortran_function(header, function);
    }
    text + "  end interface\n"
}

fn fortran_type(header: &Header, Struct { name, fields }: &Struct) -> String {
    let mut text = format!("\n  type, bind(c) :: {name}\n");
    // Structs without a function that initialises them begin with their size, and without arrays.
    let initialised = header.functions.iter().any(|function| function.name == format!("{name}_init"));
    for Field { name: field, kind, length } in fields {
        let shape = length.as_ref().map_or(String::new(), |length| format!("({length})"));
        let (kind, default) = match (target(kind), field.as_str()) {
            (Some(_), _) => ("type(c_ptr)", "c_null_ptr".to_owned()),
            (None, "struct_size") => (value(kind)[0], size(header, fields).to_string()),
            (None, _) => (value(kind)[0], "0".to_owned()),
        };
        let default = if initialised { String::new() } else { format!(" = {default}") };
        writeln!(text, "    {kind} :: {field}{shape}{default}").unwrap();
    }
    text + &format!("  end type {name}\n")
}

/// Size of a struct [bytes] on a 64-bit machine.
fn size(header: &Header, fields: &[Field]) -> usize {
    let end = fields.iter().fold(0_usize, |end, field| {
        let size = if field.kind.ends_with("int32_t") || field.kind == "nw_regime" { 4 } else { 8 };
        let length = field.length.as_ref().map_or(1, |length| header.number(length).parse().unwrap());
        end.next_multiple_of(size) + size * length
    });
    end.next_multiple_of(8)
}

fn fortran_function(header: &Header, Function { name, result, arguments }: &Function) -> String {
    let kind = if result == "void" { "subroutine" } else { "function" };
    let names: Vec<String> = arguments.iter().map(|argument| argument.name.clone()).collect();
    let mut text = format!("    {kind} {name}({}) bind(c)\n      import\n", names.join(", "));
    // A line of Fortran ends at 132 characters.
    if text.lines().any(|line| line.len() > 120) {
        let names = wrapped(names, "        ").replace('\n', " &\n");
        text = format!("    {kind} {name}( &\n{names}) bind(c)\n      import\n");
    }
    for Field { name, kind, .. } in arguments {
        let (declared, shape) = match target(kind) {
            None => (format!("{}, value", value(kind)[0]), ""),
            Some(("nw_model", _)) => ("type(c_ptr), value".to_owned(), ""),
            Some(("nw_model *", _)) => ("type(c_ptr), intent(inout)".to_owned(), ""),
            Some((to, written)) => {
                let intent = if written { "inout" } else { "in" };
                match to {
                    "char" => (format!("character(kind=c_char), intent({intent})"), "(*)"),
                    to if is_struct(header, to) => (format!("type({to}), intent({intent})"), ""),
                    to => (format!("{}, intent({intent})", value(to)[0]), ""),
                }
            }
        };
        writeln!(text, "      {declared} :: {name}{shape}").unwrap();
    }
    match target(result) {
        Some(_) => writeln!(text, "      type(c_ptr) :: {name}").unwrap(),
        None if result != "void" => writeln!(text, "      {} :: {name}", value(result)[0]).unwrap(),
        None => {}
    }
    text + &format!("    end {kind} {name}\n\n")
}

// --- Python ----------------------------------------------------------------------------------------------------------

pub fn python(header: &Header) -> String {
    let mut text = String::new();
    for (name, value) in &header.numbers {
        writeln!(text, "{} = {value}", name.trim_start_matches("NW_")).unwrap();
    }
    let quoted = |name: &str| format!("\"{name}\"");
    let names = INPUTS.iter().map(|input| quoted(input.name));
    writeln!(text, "\n# The inputs of an impact; nearwall.h describes them.").unwrap();
    writeln!(text, "INPUTS = (\n{})\n", wrapped(names, "    ")).unwrap();
    for Struct { name, fields } in &header.structs {
        let fields = fields.iter().map(|Field { name, kind, length }| {
            let length =
                length.as_ref().map_or(String::new(), |l| format!(" * {}", l.trim_start_matches("NW_")));
            format!(
                "(\"{name}\", {}{length})",
                if target(kind).is_some() { "c_void_p" } else { value(kind)[1] }
            )
        });
        let fields = wrapped(fields, "        ");
        writeln!(text, "\nclass {name}(Structure):\n    _fields_ = [\n{fields}]\n").unwrap();
    }
    let argument = |Field { kind, .. }: &Field| match target(kind) {
        None => value(kind)[1].to_owned(),
        Some(("char", _)) => "c_char_p".to_owned(),
        Some(("nw_model", _)) => "c_void_p".to_owned(),
        Some(("nw_model *", _)) => "POINTER(c_void_p)".to_owned(),
        Some((to, _)) if is_struct(header, to) => format!("POINTER({to})"),
        Some((to, _)) => format!("POINTER({})", value(to)[1]),
    };
    text += "\n# Result and arguments of every function.\nFUNCTIONS = {\n";
    for Function { name, result, arguments } in &header.functions {
        let result = match result.as_str() {
            "void" => "None",
            "const char *" => "c_char_p",
            kind => value(kind)[1],
        };
        let arguments = arguments.iter().map(argument).collect::<Vec<_>>().join(", ");
        writeln!(text, "    \"{name}\": ({result}, [{arguments}]),").unwrap();
    }
    text + "}\n"
}

// --- Rust ------------------------------------------------------------------------------------------------------------

fn rust_kind(header: &Header, kind: &str) -> String {
    match target(kind) {
        None => value(kind)[2].to_owned(),
        Some((to, written)) => {
            let to = match to {
                "char" => "c_char".to_owned(),
                "nw_model" => "nw_model".to_owned(),
                to if is_struct(header, to) => to.to_owned(),
                to => rust_kind(header, to),
            };
            format!("*{} {to}", if written { "mut" } else { "const" })
        }
    }
}

fn rust_signature(header: &Header, Function { result, arguments, .. }: &Function) -> String {
    let arguments: Vec<String> = arguments.iter().map(|argument| rust_kind(header, &argument.kind)).collect();
    let result = if result == "void" { String::new() } else { format!(" -> {}", rust_kind(header, result)) };
    format!("unsafe extern \"C\" fn({}){result}", arguments.join(", "))
}

/// The structs and functions that the example uses.
pub fn rust_example(header: &Header, example: &str) -> String {
    let own = super::with_block(example, "");
    let used = |name: &str| own.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == name);
    let mut text = format!("const NW_ABI_VERSION: u32 = {};\n", header.number("NW_ABI_VERSION"));
    text += "\n#[repr(C)]\nstruct nw_model {\n    _opaque: [u8; 0],\n}\n";
    for Struct { name, fields } in header.structs.iter().filter(|one| used(&one.name)) {
        writeln!(text, "\n#[repr(C)]\n#[derive(Default)]\nstruct {name} {{").unwrap();
        for Field { name, kind, length } in fields {
            let kind = rust_kind(header, kind);
            let kind = length.as_ref().map_or(kind.clone(), |l| format!("[{kind}; {}]", header.number(l)));
            writeln!(text, "    {name}: {kind},").unwrap();
        }
        text += "}\n";
    }
    text += "\n";
    for function in header.functions.iter().filter(|function| used(&function.name)) {
        let start = format!("type {} =", function.name);
        let signature = rust_signature(header, function);
        let gap = if start.len() + signature.len() > 108 { "\n    " } else { " " };
        writeln!(text, "{start}{gap}{signature};").unwrap();
    }
    text
}

/// Lists for macros of the tests.
pub fn rust_tests(header: &Header) -> String {
    let mut text = "//! What `nearwall.h` declares, for macros of the tests. Generated: \
                    `NEARWALL_BLESS=1 cargo test --test library interface` writes it again.\n"
        .to_owned();
    let mut list = |name: &str, rows: Vec<String>| {
        write!(text, "\nmacro_rules! {name} {{\n    ($define:ident) => {{\n        $define! {{\n").unwrap();
        rows.iter().for_each(|row| writeln!(text, "            {row}").unwrap());
        text += "        }\n    };\n}\n";
    };
    let row = |function: &Function| format!("{}: {},", function.name, rust_signature(header, function));
    list("for_each_function", header.functions.iter().map(row).collect());
    let row = |Struct { name, fields }: &Struct| {
        let fields: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
        format!("{name} {{ {} }}", fields.join(" "))
    };
    list("for_each_struct", header.structs.iter().map(row).collect());
    list("for_each_number", header.numbers.iter().map(|(name, _)| name.clone()).collect());
    text + "\npub(crate) use {for_each_function, for_each_number, for_each_struct};\n"
}

// --- docs ------------------------------------------------------------------------------------------------------------

pub fn inputs_table() -> String {
    let usual = Impact::default();
    let row = |Input { name, about, unit, value, .. }: &Input| {
        let default = match (*name, *unit) {
            ("v_n", _) => "required".to_owned(),
            (_, "1") => value(&usual).to_string(),
            _ => format!("{:e} {unit}", value(&usual)).replace("e0 ", " ").replace("2.9315e2", "293.15"),
        };
        format!(
            "| `{name}` | {} | {default} |\n",
            about.trim_end_matches('.').replacen(
                about.chars().next().unwrap(),
                &about[..1].to_lowercase(),
                1
            )
        )
    };
    format!(
        "\n| input | meaning | default |\n|---|---|---|\n{}\n",
        INPUTS.iter().map(row).collect::<String>()
    )
}

//! Blocks as PLCopen XML (TC6), which CODESYS and TwinCAT import. The namespace is the one that both write.

use std::fmt::Write as _;

use crate::structured_text::{Block, Initial, Kind, Use, Variable};

/// Text as content of XML.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    let text = text.replace('>', "&gt;").replace('"', "&quot;");
    // XML has no other control characters.
    text.chars()
        .filter(|c| !c.is_control() || *c == '\n')
        .collect()
}

/// Text in the element for formatted text.
fn formatted(text: &str) -> String {
    let text = escaped(text);
    format!("<xhtml xmlns=\"http://www.w3.org/1999/xhtml\">{text}</xhtml>")
}

fn simple(value: &str) -> String {
    format!("<simpleValue value=\"{}\"/>", escaped(value))
}

fn variable(of: &Variable) -> String {
    let base = match &of.kind {
        Kind::Elementary(name) => format!("<{name}/>"),
        Kind::Block(name) => format!("<derived name=\"{}\"/>", escaped(name)),
    };
    let initial = |value: &str| format!("<initialValue>{value}</initialValue>");
    let (kind, initial) = match &of.initial {
        Initial::Default => (base, String::new()),
        Initial::One(value) => (base, initial(&simple(value))),
        Initial::Array(values) => {
            let last = values.len().saturating_sub(1);
            let values = values.iter().fold(String::new(), |list, value| {
                list + "<value>" + &simple(value) + "</value>\n"
            });
            (
                format!(
                    "<array><dimension lower=\"0\" upper=\"{last}\"/><baseType>{base}</baseType></array>"
                ),
                initial(&format!("<arrayValue>\n{values}</arrayValue>")),
            )
        }
    };
    format!(
        "<variable name=\"{}\"><type>{kind}</type>{initial}<documentation>{}</documentation></variable>\n",
        escaped(&of.name),
        formatted(&of.comment)
    )
}

fn list((of, variables): &(Use, Vec<Variable>)) -> String {
    let (element, attribute) = match of {
        Use::Input => ("inputVars", ""),
        Use::Output => ("outputVars", ""),
        Use::Local => ("localVars", ""),
        Use::Constant => ("localVars", " constant=\"true\""),
    };
    let variables: String = variables.iter().map(variable).collect();
    format!("<{element}{attribute}>\n{variables}</{element}>\n")
}

/// A project of these blocks, made on a `day` such as 2026-11-28.
pub(crate) fn project(title: &str, day: &str, blocks: &[Block]) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
         <project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">\n\
         <fileHeader companyName=\"\" productName=\"jred\" productVersion=\"{}\" creationDateTime=\"{day}T00:00:00\"/>\n\
         <contentHeader name=\"{}\"><coordinateInfo><fbd><scaling x=\"1\" y=\"1\"/></fbd><ld><scaling x=\"1\" y=\"1\"/></ld>\
         <sfc><scaling x=\"1\" y=\"1\"/></sfc></coordinateInfo></contentHeader>\n\
         <types>\n<dataTypes/>\n<pous>\n",
        env!("CARGO_PKG_VERSION"),
        escaped(&title.replace(['\n', '\r'], " "))
    );
    for block in blocks {
        let interface: String = block.lists.iter().map(list).collect();
        let _ = write!(
            text,
            "<pou name=\"{}\" pouType=\"functionBlock\">\n<interface>\n{interface}<documentation>{}</documentation>\n</interface>\n\
             <body><ST>{}</ST></body>\n</pou>\n",
            escaped(&block.name),
            formatted(&block.about),
            formatted(&block.body)
        );
    }
    text + "</pous>\n</types>\n<instances><configurations/></instances>\n</project>\n"
}

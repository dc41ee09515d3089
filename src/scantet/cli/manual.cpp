// The walk over the declared options that help.cpp makes, rendered with the macros of man(7).
#include "scantet/cli/manual.h"

#include <sstream>

#include "scantet/base/ascii_text.h"
#include "scantet/base/version.h"
#include "scantet/cli/help.h"

namespace scantet {
namespace {

// As it stands: a hyphen stays one that can be copied, a backslash one that is seen, and no line is taken for a
// request.
std::string escaped(const std::string& text) {
  std::string result;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    starts_line = c == '\n';
  }
  return result;
}

// A sentence a line, as man(7) wants it.
std::string paragraph(const std::string& text) {
  std::istringstream words(text);
  std::string lines;
  std::string line;
  for (std::string word; words >> word;) {
    line += (line.empty() ? "" : " ") + word;
    if (word.back() == '.' || word.back() == ';' || word.back() == ':' || line.size() > 72) {
      lines += line + "\n";
      line.clear();
    }
  }
  return escaped(line.empty() ? lines : lines + line + "\n");
}

std::string heading(const std::string& name, const std::string& brief) {
  return ".\\\" Made by scantet man from the declarations in its source; do not edit.\n.TH " + ascii_upper(name) +
         " 1 \"\" \"scantet " + std::string(kVersion) + "\" \"User Commands\"\n.SH NAME\n" + escaped(name) + " \\- " +
         paragraph(brief);
}

std::string examples_manual(const std::vector<Example>& examples) {
  std::string text;
  for (const Example& example : examples) {
    text += text.empty() ? ".SH EXAMPLES\n" : ".PP\n";
    text += paragraph(example.what) + ".PP\n.RS 4\n.nf\n" + escaped(example.command) + "\n.fi\n.RE\n";
  }
  return text;
}

// ".B" for what is typed, ".I" for what stands for a value.
std::string option_term(const Option& option) {
  std::string term = ".TP\n";
  if (option.text.letter) term += std::string("\\fB\\-") + option.text.letter + "\\fR, ";
  term += "\\fB" + escaped("--" + option.name) + "\\fR";
  if (!option.text.metavar.empty()) term += " \\fI" + escaped(option.text.metavar) + "\\fR";
  return term + "\n";
}

std::string option_manual(const Option& option) {
  const std::string facts = option_facts(option);
  return option_term(option) + paragraph(option.text.help + (facts.empty() ? "" : " [" + facts + "]"));
}

std::string exit_status_manual() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitStatus& exit : exit_statuses()) {
    text += ".TP\n.B " + std::to_string(exit.status) + "\n" + paragraph(exit.meaning);
  }
  return text;
}

}  // namespace

std::string program_manual(const std::vector<std::unique_ptr<Command>>& commands) {
  std::string text = heading("scantet", "tetrahedral meshes from medical scans");
  text += ".SH SYNOPSIS\n.B scantet\n.I command\n.RI [ arguments ]\n.RI [ options ]\n";
  text += ".SH DESCRIPTION\n" + paragraph(kProgramPurpose) + ".SH COMMANDS\n";
  for (const auto& command : commands) {
    text += ".TP\n.BR scantet\\-" + escaped(command->text().name) + " (1)\n" + paragraph(command->text().brief);
  }
  text += ".SH OPTIONS\n.TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\n" + paragraph("What the program, or a command, does.") +
          ".TP\n.B \\-\\-version\n" + paragraph("Its version.");
  std::vector<Example> examples;
  for (const auto& command : commands) {
    if (!command->text().examples.empty()) examples.push_back(command->text().examples.front());
  }
  text += exit_status_manual() + examples_manual(examples);
  text += ".SH SEE ALSO\n";
  for (const auto& command : commands) {
    text += ".BR scantet\\-" + escaped(command->text().name) + " (1)" + (command == commands.back() ? "\n" : ",\n");
  }
  return text;
}

std::string command_manual(const Command& command) {
  const CommandText& about = command.text();
  std::string text = heading("scantet-" + about.name, about.brief);
  text += ".SH SYNOPSIS\n.B scantet " + escaped(about.usage) + "\n.SH DESCRIPTION\n" + paragraph(about.about);
  if (!about.notes.empty()) text += ".PP\n" + paragraph(about.notes);
  text += ".SH OPTIONS\n";
  for (const OptionGroup& group : option_groups(command)) {
    text += ".SS " + escaped(group.title) + "\n";
    for (const Option* option : group.options) text += option_manual(*option);
  }
  text += ".SS Help\n.TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\n" + paragraph("The same in short.");
  return text + exit_status_manual() + examples_manual(about.examples) + ".SH SEE ALSO\n.BR scantet (1)\n";
}

}  // namespace scantet

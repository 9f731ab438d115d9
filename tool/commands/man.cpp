// man: the manual pages, of the program and of each command.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "formats/input_error.hpp"
#include "formats/output_file.hpp"
#include "formats/program.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/usage.hpp"
#include "tool/run/date.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

/// Text that roff prints as it stands: no line of it is a request.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((out.empty() || out.back() == '\n') && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }

/// Capital letters stand for what a user fills in.
std::string value_in_roff(const std::string& text) {
  std::string out;
  bool italic = false;
  for (const char c : text) {
    const bool filled_in = (c >= 'A' && c <= 'Z') || (italic && (c == '_' || c == '-'));
    if (filled_in != italic) out += filled_in ? "\\fI" : "\\fR";
    italic = filled_in;
    out += roff(std::string_view(&c, 1));
  }
  return out + (italic ? "\\fR" : "");
}

std::string options_in_roff(const CLI::App& command, std::string_view heading) {
  std::string text;
  for (const OptionGroup& group : option_groups(command)) {
    text += fmt::format(".{} \"{}\"\n", heading, roff(group.title));
    for (const OptionUsage& option : group.options) {
      std::string names;
      for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
      text += fmt::format(".TP\n{}{}\n{}\n", names,
                          value_in_roff(option.names.empty() ? option.value : option.value_text()), roff(option.about));
    }
  }
  return text;
}

std::string synopsis_in_roff(const CLI::App& command) {
  const std::string name = full_name(command);
  return bold(name) + value_in_roff(synopsis(command).substr(name.size())) + "\n";
}

/// "contact-oracle-certify", the name of a page.
std::string page_name(const CLI::App& command) {
  return command.get_parent() == nullptr ? command.get_name()
                                         : fmt::format("{}-{}", command.get_parent()->get_name(), command.get_name());
}

/// The title and the name. It has a date where SOURCE_DATE_EPOCH says which, so that it is the same every day.
std::string head_of(const CLI::App& command) {
  std::string title = page_name(command);
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const std::string date = std::getenv("SOURCE_DATE_EPOCH") != nullptr ? issue_date() : "";
  const auto [first, rest] = description_of(command);
  return fmt::format(".TH \"{}\" \"1\" \"{}\" \"contact\\-oracle {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                     roff(title), date, formats::version(), roff(page_name(command)), roff(first));
}

std::string references(const CLI::App& app, const CLI::App* but) {
  std::string text;
  for (const CommandGroup& group : command_groups(app))
    for (const CLI::App* command : group.commands)
      if (command != but) text += fmt::format(".BR {} (1),\n", roff(page_name(*command)));
  return text.substr(0, text.size() - 2) + "\n";
}

std::string page_of_program(const CLI::App& app) {
  std::string text = head_of(app) + ".SH SYNOPSIS\n" + synopsis_in_roff(app) + ".SH DESCRIPTION\n" +
                     roff(description_of(app).second) + "\n.SH COMMANDS\n";
  for (const CommandGroup& group : command_groups(app)) {
    text += fmt::format(".SS \"{}\"\n", roff(group.title));
    for (const CLI::App* command : group.commands)
      text += fmt::format(".TP\n{}\n{}\n", bold(command->get_name()), roff(description_of(*command).first));
  }
  text += options_in_roff(app, "SH") + ".SH \"EXIT STATUS\"\n";
  for (const auto& [status, meaning] : exit_meanings()) text += fmt::format(".TP\n{}\n{}\n", status, roff(meaning));
  return text +
         ".SH ENVIRONMENT\n"
         ".TP\n.B NO_COLOR\nNo colours where \\fB\\-\\-color\\fR does not say otherwise.\n"
         ".TP\n.B SOURCE_DATE_EPOCH\nThe day that certificates, exams and manual pages are dated.\n"
         ".SH \"SEE ALSO\"\n" +
         references(app, nullptr);
}

std::string page_of_command(const CLI::App& app, const CLI::App& command) {
  const std::vector<const CLI::App*> inner = command.get_subcommands([](const CLI::App*) { return true; });
  std::string text = head_of(command) + ".SH SYNOPSIS\n";
  if (inner.empty()) text += synopsis_in_roff(command);
  for (std::size_t i = 0; i < inner.size(); ++i) text += (i == 0 ? "" : ".br\n") + synopsis_in_roff(*inner[i]);
  const auto [first, rest] = description_of(command);
  text += fmt::format(".SH DESCRIPTION\n{}.\n{}{}", roff(first), roff(rest), rest.empty() ? "" : "\n");
  text += options_in_roff(command, "SH");
  for (const CLI::App* one : inner)
    text += fmt::format(".SH \"{}\"\n{}.\n", roff(full_name(*one)), roff(description_of(*one).first)) +
            options_in_roff(*one, "SS");
  if (!command.get_footer().empty()) text += ".SH NOTES\n.nf\n" + roff(command.get_footer()) + "\n.fi\n";
  return text +
         fmt::format(
             ".SH \"EXIT STATUS\"\nThat of\n.BR {} (1),\nwhich says too what every command takes.\n"
             ".SH \"SEE ALSO\"\n.BR {} (1),\n",
             roff(app.get_name()), roff(app.get_name())) +
         references(app, &command);
}

std::string page_of(const CLI::App& app, const CLI::App* command) {
  return command == nullptr ? page_of_program(app) : page_of_command(app, *command);
}

void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
  make_folder(folder, "--all");
  std::vector<const CLI::App*> pages{nullptr};
  for (const CommandGroup& group : command_groups(app))
    pages.insert(pages.end(), group.commands.begin(), group.commands.end());
  for (const CLI::App* page : pages) {
    formats::OutputFile file(folder / (page_name(page == nullptr ? app : *page) + ".1"));
    file.write(page_of(app, page));
    file.commit();
  }
}

}  // namespace

void add_man(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("man", "The manual page of the program or of a command, for `man -l -`");
  struct ManOptions {
    std::string command;
    std::string folder;
  };
  auto o = std::make_shared<ManOptions>();
  auto* name = command->add_option("command", o->command, "The command")->type_name("COMMAND");
  command
      ->add_option("--all", o->folder,
                   "Write every page into this folder: contact-oracle.1, contact-oracle-certify.1, ...")
      ->type_name("FOLDER")
      ->excludes(name);
  command->callback([&app, o, &exit] {
    const CLI::App* of = o->command.empty() ? nullptr : find_command(app, o->command);
    if (!o->command.empty() && (of == nullptr || of->get_group().empty()))
      throw formats::InputError({"man", 0}, "",
                                fmt::format("no command '{}'; `contact-oracle help all` lists them", o->command));
    if (o->folder.empty())
      fmt::print("{}", page_of(app, of));
    else
      write_pages(app, o->folder);
    exit = kCertified;
  });
}

}  // namespace contact::tool

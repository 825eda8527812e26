#include "parse_options.hpp"

#include <algorithm>
#include <sstream>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "command.hpp"
#include "gdal_spellings.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kHelpColumn = 31;

/// One line an option, so that a command's help fits on one screen.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter(std::string usage, std::vector<std::string> examples)
        : usage_(std::move(usage)), examples_(std::move(examples)) {}

    std::string make_help(const CLI::App* app, std::string /*name*/,
                          CLI::AppFormatMode /*mode*/) const override {
        std::ostringstream text;
        text << "Usage: " << app->get_name() << " " << usage_ << "\n" << app->get_description() << "\n\n";
        for (const CLI::Option* option : app->get_options()) {
            // Options without a group are told of in the manual page only.
            if (option->nonpositional() && !option->get_group().empty()) {
                text << option_line(*option);
            }
        }
        text << "\nExamples:\n";
        for (const std::string& example : examples_) {
            text << "  " << example << "\n";
        }
        return text.str();
    }

  private:
    static std::string option_line(const CLI::Option& option) {
        std::string left =
            option.get_snames().empty() ? "      " : "  -" + option.get_snames().front() + ", ";
        if (option.get_lnames().empty()) {
            left = "  -" + option.get_snames().front();
        } else {
            left += "--" + option.get_lnames().front();
        }
        if (!option.get_type_name().empty()) {
            left += " " + option.get_type_name();
        }
        left.resize(std::max(left.size() + 1, kHelpColumn), ' ');
        return left + option.get_description() + "\n";
    }

    std::string usage_;
    std::vector<std::string> examples_;
};

std::string see_help(const CLI::App& parser) { return "; see \"" + parser.get_name() + " --help\""; }

/// The parser's own texts repeat user input raw and speak of TEXT and INT; only their kind is used.
[[noreturn]] void refuse(const CLI::App& parser, const CLI::ParseError& error) {
    const std::string text = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        const std::vector<std::string> extras = parser.remaining();
        throw UsageError("unknown option " + io::quoted(extras.empty() ? text : extras.front()) +
                         see_help(parser));
    }
    const std::string name = text.substr(0, text.find_first_of(": "));
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        for (const CLI::Option* option : parser.get_options()) {
            if (option->get_name(false, true) == name || option->get_name() == name) {
                if (option->get_type_name().empty()) {
                    throw UsageError(name + " takes no value");
                }
                if (!text.ends_with(" missing")) {
                    throw UsageError(name + " is given more than once");
                }
                throw UsageError(name + " needs " + option->get_type_name() + see_help(parser));
            }
        }
    }
    throw UsageError(io::quoted(text) + see_help(parser));
}

}  // namespace

std::unique_ptr<CLI::App> make_parser(const std::string& command, const std::string& summary,
                                      const std::string& usage, const std::vector<std::string>& examples) {
    auto parser = std::make_unique<CLI::App>(summary, "tinwright " + command);
    parser->formatter(std::make_shared<HelpFormatter>(usage, examples));
    parser->set_help_flag("-h,--help", "this screen; \"tinwright help " + command + "\" tells all");
    return parser;
}

CLI::Option* add_value(CLI::App& parser, const std::string& names, std::string& value,
                       const std::string& placeholder, const std::string& help) {
    return parser.add_option(names, value, help)->type_name(placeholder);
}

CLI::Option* add_repeatable(CLI::App& parser, const std::string& names, std::vector<std::string>& values,
                            const std::string& placeholder, const std::string& help) {
    return parser.add_option(names, values, help)->type_name(placeholder)->allow_extra_args(false);
}

CLI::Option* add_values(CLI::App& parser, const std::string& names, std::vector<std::string>& values,
                        int count, const std::string& placeholder, const std::string& help) {
    return parser.add_option(names, values, help)
        ->type_name(placeholder)
        ->type_size(count)
        ->expected(1)
        ->allow_extra_args(false);
}

void parse_options(CLI::App& parser, const std::vector<std::string>& arguments) {
    std::vector<std::string> tokens = rewrite_gdal_spellings(arguments);
    std::reverse(tokens.begin(), tokens.end());  // the parser takes them from the back
    try {
        parser.parse(tokens);
    } catch (const CLI::CallForHelp&) {
        throw HelpRequest{parser.help()};
    } catch (const CLI::ParseError& error) {
        refuse(parser, error);
    }
}

}  // namespace tinwright::tools

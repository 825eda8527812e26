#ifndef TINWRIGHT_TOOLS_PARSE_OPTIONS_HPP
#define TINWRIGHT_TOOLS_PARSE_OPTIONS_HPP

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// What the commands' option parsers share: how help looks and how errors read.
namespace tinwright::tools {

/// A parser for `tinwright <command>`. `usage` is what follows the command's name; `examples` are whole
/// lines.
std::unique_ptr<CLI::App> make_parser(const std::string& command, const std::string& summary,
                                      const std::string& usage, const std::vector<std::string>& examples);

/// An option with one value each time it is given; giving it twice is an error.
CLI::Option* add_value(CLI::App& parser, const std::string& names, std::string& value,
                       const std::string& placeholder, const std::string& help);
/// An option that may be given several times, with exactly one value each time.
CLI::Option* add_repeatable(CLI::App& parser, const std::string& names, std::vector<std::string>& values,
                            const std::string& placeholder, const std::string& help);
/// An option with exactly `count` values.
CLI::Option* add_values(CLI::App& parser, const std::string& names, std::vector<std::string>& values,
                        int count, const std::string& placeholder, const std::string& help);

/// Parses GDAL's spellings and our own. Throws UsageError or HelpRequest.
void parse_options(CLI::App& parser, const std::vector<std::string>& arguments);

}  // namespace tinwright::tools

#endif

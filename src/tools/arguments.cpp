// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "core/error.h"

namespace lampyris {

namespace {

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& n : option->get_lnames()) names.push_back("--" + n);
    for (const std::string& n : option->get_snames()) names.push_back("-" + n);
  }
  return names;
}

std::string unexpected(const CLI::App& app, const std::string& argument) {
  if (argument.size() < 2 || argument[0] != '-')
    return fmt::format("unexpected argument \"{}\"", argument);
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("unknown option \"{}\"{}", name, didYouMean(name, optionNames(app)));
}

}  // namespace

std::optional<int> parseArguments(CLI::App& app, const Arguments& arguments) {
  app.allow_extras();
  const auto names = optionNames(app);
  Arguments reversed;
  for (const std::string& a : arguments) {
    // pbrt-v3 takes its long options with one dash as well.
    const std::string twoDashes = "-" + a.substr(0, a.find('='));
    const bool oneDash = a.size() > 2 && a[0] == '-' && a[1] != '-' &&
                         std::find(names.begin(), names.end(), twoDashes) != names.end();
    reversed.push_back(oneDash ? "-" + a : a);
  }
  std::reverse(reversed.begin(), reversed.end());
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return kDone;
  } catch (const CLI::CallForVersion& e) {
    fmt::print("{}\n", e.what());
    return kDone;
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
  const auto extras = app.remaining();
  if (!extras.empty()) throw UsageError(unexpected(app, extras.front()));
  return std::nullopt;
}

}  // namespace lampyris

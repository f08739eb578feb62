// SPDX-License-Identifier: Apache-2.0
/// The command line, as all subcommands read it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lampyris {

using Arguments = std::vector<std::string>;

/// A fault of the command line: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum ExitCode : int {
  kDone = 0,
  kSceneError = 1,
  kUsageError = 2,
  kIoError = 3,
  kInterrupted = 130
};

/// Parses. Returns an exit code where that is all there is to do (--help). Throws UsageError, with
/// a suggestion where an option is misspelt.
std::optional<int> parseArguments(CLI::App& app, const Arguments& arguments);

}  // namespace lampyris

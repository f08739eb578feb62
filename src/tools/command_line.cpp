// SPDX-License-Identifier: Apache-2.0
#include "tools/command_line.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/memory.h"
#include "tools/commands.h"
#include "tools/messages.h"

namespace lampyris {

namespace {

struct Command {
  std::string_view name;
  int (*run)(const Arguments&);
};
int runHelp(const Arguments&) { return runRender({"--help"}); }

constexpr std::array kCommands = {
    Command{"assemble", runAssemble},    Command{"makesky", runMakeSky},
    Command{"compare", runCompare},      Command{"convert", runConvert},
    Command{"help-scene", runHelpScene}, Command{"info", runInfo},
    Command{"lights", runLights},        Command{"cache", runCache},
    Command{"merge", runMerge},          Command{"help", runHelp},
};

int run(Arguments arguments) {
  for (const Command& c : kCommands) {
    if (arguments.empty() || arguments.front() != c.name) continue;
    arguments.erase(arguments.begin());
    return c.run(arguments);
  }
  return runRender(arguments);
}

int fail(int code, std::string_view message) {
  say("lampyris: error: {}\n", message);
  return code;
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  try {
    return run(Arguments(argv + std::min(argc, 1), argv + argc));
  } catch (const UsageError& e) {
    return fail(kUsageError, fmt::format("{}\n(lampyris --help shows the usage)", e.what()));
  } catch (const SceneError& e) {
    return fail(kSceneError, e.what());
  } catch (const std::bad_alloc&) {
    const MemoryLimit left = memoryLimit();
    return fail(kIoError, fmt::format("out of memory, with {} in use; the limit is {} more ({})",
                                      memoryText(usedMemory()), memoryText(left.bytes), left.name));
  } catch (const std::exception& e) {
    return fail(kIoError, e.what());
  }
}

}  // namespace lampyris

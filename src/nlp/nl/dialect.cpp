#include "dialect.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "../backends.hpp"
#include "slalom/base/error.hpp"

namespace slalom::nlp {
namespace {

std::vector<std::string> words_of(const NativeOptions& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : options)
    words.push_back(
        std::visit([&name = name](const auto& v) { return fmt::format("{}={}", name, v); }, value));
  return words;
}

/// ripopt has Ipopt's names, but knows its own options only.
std::vector<std::string> ripopt_words(const Options& options) {
  return words_of({{"print_level", options.print_level},
                   {"max_iter", options.max_iterations},
                   {"tol", options.tol},
                   {"constr_viol_tol", options.constraint_tol}});
}

}  // namespace

std::vector<std::string> command_words(const std::string& executable, const Options& options) {
  const auto is = [&](const char* name) { return executable.rfind(name, 0) == 0; };
  if (options.floor > 0 && !is("ipopt"))
    throw InvalidValue("solver options: floor", fmt::format("{} for {}", options.floor, executable),
                       "0: through a .nl file only ipopt stops at a floor");
  std::vector<std::string> words;
  if (is("ipopt")) words = words_of(ipopt_options(options));
  if (is("ripopt")) words = ripopt_words(options);
  if (is("knitro")) words = words_of(knitro_options(options));
  std::istringstream more(options.nl_options);
  for (std::string word; more >> word;) words.push_back(word);
  return words;
}

}  // namespace slalom::nlp

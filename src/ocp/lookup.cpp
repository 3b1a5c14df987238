#include "lookup.hpp"

#include <algorithm>

#include "slalom/base/error.hpp"
#include "slalom/base/options.hpp"

namespace slalom::ocp {

std::size_t index_of(const std::string& name, const std::vector<std::string>& known,
                     const char* what) {
  const auto it = std::find(known.begin(), known.end(), name);
  if (it != known.end()) return static_cast<std::size_t>(it - known.begin());
  std::string list;
  for (const auto& each : known) list += (list.empty() ? "" : ", ") + each;
  const std::string nearest = nearest_name(name, known);
  throw InvalidValue("solution", std::string("no ") + what + " '" + name + "'",
                     !nearest.empty() ? "perhaps '" + nearest + "'"
                     : list.empty()   ? std::string("a problem with one")
                                      : "one of " + list);
}

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t i) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto& row : rows) result.push_back(row[i]);
  return result;
}

}  // namespace slalom::ocp

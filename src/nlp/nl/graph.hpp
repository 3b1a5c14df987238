#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "affine.hpp"

namespace slalom::nlp {

/// Number of the objective among users of a subexpression.
inline constexpr std::size_t kObjective = static_cast<std::size_t>(-1);

/// A subexpression used more than once, which becomes a defined variable of the .nl file.
struct Shared {
  const expr::Node* node = nullptr;
  bool in_objective = false;
  std::size_t rows = 0;      ///< that use it
  std::size_t last_row = 0;  ///< of them

  /// Whether one row, or the objective alone, uses it.
  bool local() const { return rows + (in_objective ? 1 : 0) == 1; }
};

/// What the nonlinear parts of all outputs use.
class Graph {
 public:
  /// Adds an output; returns the symbols in its nonlinear part. `user` is its row or kObjective.
  std::vector<const expr::Node*> add(const AffineParts& parts, std::size_t user);
  /// Shared subexpressions, arguments before users.
  std::vector<Shared> shared() const;

 private:
  struct Use {
    std::size_t references = 0;
    std::size_t last_user = kObjective - 1;  ///< none yet
    Shared shared = {};
  };
  std::unordered_map<const expr::Node*, Use> uses_;
  std::vector<const expr::Node*> roots_;
};

/// Numbers of the file's variables: v0, v1, ...; of symbols and of defined variables.
using NlNames = std::unordered_map<const expr::Node*, std::size_t>;

/// Appends a tree in prefix notation, one operation a line. Named nodes other than `root` itself
/// are written by name.
void write_tree(const expr::Node* root, bool root_by_name, const NlNames& names, std::string& out);

/// Appends a row's or objective's nonlinear part, with the constant; n0 if there is neither.
void write_sum(const AffineParts& parts, const NlNames& names, std::string& out);

}  // namespace slalom::nlp

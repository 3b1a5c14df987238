#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slalom::report {

/// Text for HTML and XML: & < > " ' escaped, control characters that XML forbids left out.
std::string escape(std::string_view text);

/// JSON that may stand inside a <script> element: no "</" and no "<!--" can occur in it. Text that
/// is not UTF-8 is repaired.
std::string script_json(const nlohmann::ordered_json& json);

/// Replaces each {{name}} of a template by its value, as it is; throws Error for a name without
/// value. Values are not searched for further names.
std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string_view, std::string>>& values);

/// A number with `digits` decimals and a proper minus sign; a dash when it is not finite.
std::string number(double value, int digits);
/// The same with `digits` significant ones: 5.86e-4 as 0.000586.
std::string significant(double value, int digits);

/// `<a href="target">text</a>`; the target is percent-encoded but for its slashes.
std::string link(std::string_view target, std::string_view text);

/// `text` with everything but letters, digits, '.', '-' and '_' replaced by '_': fit for the name
/// of a file and for an id.
std::string plain_name(std::string_view text);

}  // namespace slalom::report

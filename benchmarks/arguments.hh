// The command line of a benchmark: options by name, and what is left.
#pragma once

#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "anisomesh/features.hh"

namespace bench {

/// Says which options there are, then reads them. An option that is not known is taken for a name.
class Arguments {
 public:
  void flag(const std::string& option, bool& set) { flags_[option] = &set; }
  void value(const std::string& option, std::function<void(const std::string&)> take) {
    values_[option] = std::move(take);
  }
  void number(const std::string& option, size_t& target) {
    value(option, [&target](const std::string& text) { target = std::stoul(text); });
  }
  void number(const std::string& option, double& target) {
    value(option, [&target](const std::string& text) { target = std::stod(text); });
  }

  /// An angle in degrees, 0: none; where it is not given, features are found.
  void features(const std::string& option, anisomesh::FeatureOptions& target) {
    value(option, [&target](const std::string& text) {
      target.angle_degrees = std::stod(text);
      target.automatic = false;
    });
  }

  /// \returns what is no option and no option's value
  std::vector<std::string> read(int argc, char** argv) const {
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i) {
      const auto flag = flags_.find(argv[i]);
      const auto value = values_.find(argv[i]);
      if (flag != flags_.end())
        *flag->second = true;
      else if (value != values_.end() && i + 1 < argc)
        value->second(argv[++i]);
      else
        names.emplace_back(argv[i]);
    }
    return names;
  }

 private:
  std::map<std::string, bool*> flags_;
  std::map<std::string, std::function<void(const std::string&)>> values_;
};

}  // namespace bench

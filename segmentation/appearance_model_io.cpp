// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/whole_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVersionKey = "heel_appearance";

// --- The fields, for reading and writing alike ---------------------------------------------------

template <typename Enum>
using Names = std::vector<std::pair<Enum, std::string>>;

const Names<ColorModel> kModels = {{ColorModel::kPrincipalColors, "principal_colors"},
                                   {ColorModel::kColorRatio, "color_ratio"},
                                   {ColorModel::kHueSaturation, "hue_saturation"}};
const Names<ThresholdRule> kRules = {{ThresholdRule::kFewestErrors, "fewest_errors"},
                                     {ThresholdRule::kMostSelective, "most_selective"}};

template <typename Params, typename Visitor>
void visitParams(Params& params, Visitor& visitor) {
  visitor.choice("model", params.model, kModels);
  visitor.begin("color_ratio");
  visitor.field("dark_offset", params.color_ratio.dark_offset);
  visitor.field("chroma_limit", params.color_ratio.chroma_limit);
  visitor.field("chroma_bins", params.color_ratio.chroma_bins);
  visitor.field("brightness_bins", params.color_ratio.brightness_bins);
  visitor.field("smoothing_bins", params.color_ratio.smoothing_bins);
  visitor.field("other_weight", params.color_ratio.other_weight);
  visitor.end();
  visitor.begin("principal_colors");
  visitor.field("count", params.principal_colors.count);
  visitor.field("max_count", params.principal_colors.max_count);
  visitor.field("min_spread_drop", params.principal_colors.min_spread_drop);
  visitor.field("hue_bins", params.principal_colors.hue_bins);
  visitor.field("value_bins", params.principal_colors.value_bins);
  visitor.end();
  visitor.begin("hue_saturation");
  visitor.field("hue_bins", params.hue_saturation.hue_bins);
  visitor.field("saturation_bins", params.hue_saturation.saturation_bins);
  visitor.end();
  visitor.field("suppress_background", params.suppress_background);
  visitor.begin("threshold");
  visitor.choice("rule", params.threshold.rule, kRules);
  visitor.field("false_positive_weight", params.threshold.false_positive_weight);
  visitor.field("max_false_negative_share", params.threshold.max_false_negative_share);
  visitor.end();
  visitor.field("max_error_share", params.max_error_share);
  visitor.field("min_points", params.min_points);
}

template <typename Values, typename Visitor>
void visitStature(Values& stature, Visitor& visitor) {
  visitor.field("height_m", stature.height_m);
  visitor.field("spread_m", stature.spread_m);
  visitor.field("frames", stature.frames);
}

// --- Reading ------------------------------------------------------------------------------------

[[noreturn]] void complain(const std::string& field, const std::string& why) {
  throw std::runtime_error("its field '" + field + "' " + why);
}

const char* kindOf(double) { return "a number"; }
const char* kindOf(bool) { return "true or false"; }
const char* kindOf(int) { return "a whole number"; }
const char* kindOf(std::uint64_t) { return "a count"; }
const char* kindOf(const std::string&) { return "a text"; }

/// Reads the fields of a map, and says which is missing or wrong.
class Reader {
 public:
  explicit Reader(const YAML::Node& map, std::string path = "") : path_(std::move(path)) {
    maps_.push_back(map);
  }

  YAML::Node node(const std::string& key) const {
    const YAML::Node map = maps_.back();
    if (!map.IsMap() || !map[key]) {
      throw std::runtime_error("it has no field '" + path_ + key + "'");
    }
    return map[key];
  }

  template <typename T>
  void field(const std::string& key, T& value) const {
    try {
      value = node(key).as<T>();
    } catch (const YAML::Exception&) {
      complain(path_ + key, std::string("is not ") + kindOf(T{}));
    }
  }

  template <typename Enum>
  void choice(const std::string& key, Enum& value, const Names<Enum>& names) const {
    std::string text;
    field(key, text);
    for (const auto& [known, name] : names) {
      if (name == text) {
        value = known;
        return;
      }
    }
    complain(path_ + key, "is '" + text + "', which is not known");
  }

  void begin(const std::string& key) {
    maps_.push_back(node(key));
    path_ += key + '.';
  }

  void end() {
    maps_.pop_back();
    path_.erase(path_.find_last_of('.', path_.size() - 2) + 1);
  }

  const std::string& path() const { return path_; }

 private:
  std::vector<YAML::Node> maps_;  // from the outermost to the one being read
  std::string path_;              // of the latter, with a dot at its end
};

ColorHistogram readColors(const Reader& reader) {
  std::string text;
  reader.field("colors", text);
  const std::string field = reader.path() + "colors";
  std::istringstream lines(text);
  ColorHistogram colors;
  for (std::string line; std::getline(lines, line);) {
    unsigned b = 0;
    unsigned g = 0;
    unsigned r = 0;
    unsigned long long count = 0;
    char rest = 0;
    if (std::sscanf(line.c_str(), "%u %u %u %llu %c", &b, &g, &r, &count, &rest) != 4) {
      complain(field, "has a line that is not 'blue green red count': '" + line + "'");
    }
    if (std::max({b, g, r}) > 255) complain(field, "has a colour out of range: '" + line + "'");
    colors.add(
        {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(r)},
        count);
  }
  return colors;
}

BodyDescription readPortrait(const YAML::Node& stripes) {
  BodyDescription portrait;
  if (!stripes.IsSequence() || stripes.size() != BodyDescriber::kStripes) {
    complain("portrait",
             "is not a list of " + std::to_string(BodyDescriber::kStripes) + " stripes");
  }
  portrait.colors.setZero(BodyDescriber::kBins, BodyDescriber::kStripes);
  for (int stripe = 0; stripe < BodyDescriber::kStripes; ++stripe) {
    const std::string field = "portrait[" + std::to_string(stripe) + "]";
    if (!stripes[stripe].IsScalar()) complain(field, "is not a text");
    std::istringstream lines(stripes[stripe].as<std::string>());
    auto column = portrait.colors.col(stripe);
    for (std::string line; std::getline(lines, line);) {
      int bin = 0;
      float share = 0.0F;
      char rest = 0;
      const bool is_read = std::sscanf(line.c_str(), "%d %f %c", &bin, &share, &rest) == 2;
      if (!is_read || bin < 0 || bin >= BodyDescriber::kBins || !(share >= 0.0F && share <= 1.0F)) {
        complain(field, "has a line that is not 'bin share': '" + line + "'");
      }
      column[bin] = share;
    }
    if (column.sum() > 1.01F) complain(field, "has shares of more than 1 in all");
  }
  return portrait;
}

AppearanceModel readModel(const YAML::Node& root) {
  Reader reader(root);
  int version = 0;
  reader.field(kVersionKey, version);
  if (version > kAppearanceFormat) {
    throw std::runtime_error("it has format version " + std::to_string(version) +
                             ", but this program knows only versions up to " +
                             std::to_string(kAppearanceFormat));
  }
  if (version < 1) complain(kVersionKey, "is not a version of the format");
  AppearanceParams params;
  visitParams(params, reader);

  const YAML::Node bands = reader.node("bands");
  if (!bands.IsSequence()) complain("bands", "is not a list");
  params.bands.clear();
  std::vector<ColorHistogram> person;
  std::vector<std::uint8_t> thresholds;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Reader band(bands[i], "bands[" + std::to_string(i) + "].");
    BodyBand body;
    band.field("name", body.name);
    band.field("min_height_m", body.min_height_m);
    band.field("max_height_m", body.max_height_m);
    int threshold = 0;
    band.field("threshold", threshold);
    if (threshold < 0 || threshold > 255) complain(band.path() + "threshold", "is not in 0 to 255");
    params.bands.push_back(body);
    thresholds.push_back(static_cast<std::uint8_t>(threshold));
    person.push_back(readColors(band));
  }
  std::optional<Stature> stature;
  if (root["stature"]) {
    reader.begin("stature");
    visitStature(stature.emplace(), reader);
    reader.end();
  }
  BodyDescription portrait;
  if (version >= 2) portrait = readPortrait(reader.node("portrait"));
  reader.begin("room");
  AppearanceModel model(std::move(params), std::move(person), readColors(reader), stature,
                        std::move(portrait));
  for (std::size_t i = 0; i < thresholds.size(); ++i) model.setThreshold(i, thresholds[i]);
  return model;
}

// --- Writing ------------------------------------------------------------------------------------

/// Writes what a Reader reads.
class Writer {
 public:
  explicit Writer(YAML::Emitter& out) : out_(out) {}

  template <typename T>
  void field(const char* key, const T& value) {
    out_ << YAML::Key << key << YAML::Value << value;
  }

  template <typename Enum>
  void choice(const char* key, Enum value, const Names<Enum>& names) {
    for (const auto& [known, name] : names) {
      if (known == value) field(key, name);
    }
  }

  void begin(const char* key) { out_ << YAML::Key << key << YAML::Value << YAML::BeginMap; }
  void end() { out_ << YAML::EndMap; }

 private:
  YAML::Emitter& out_;
};

void writeColors(YAML::Emitter& out, const ColorHistogram& colors) {
  std::string lines;
  colors.forEach([&](Bgr c, std::uint64_t count) {
    lines += std::to_string(c.b) + ' ' + std::to_string(c.g) + ' ' + std::to_string(c.r) + ' ' +
             std::to_string(count) + '\n';
  });
  out << YAML::Key << "colors" << YAML::Value << YAML::Literal << lines;
}

void writePortrait(YAML::Emitter& out, const BodyDescription& portrait) {
  out << YAML::Key << "portrait"
      << YAML::Comment("how each stripe of height is spread over the bins of colour: bin share")
      << YAML::Value << YAML::BeginSeq;
  for (Eigen::Index stripe = 0; stripe < portrait.colors.cols(); ++stripe) {
    std::string lines;
    for (Eigen::Index bin = 0; bin < portrait.colors.rows(); ++bin) {
      const auto share = static_cast<double>(portrait.colors(bin, stripe));
      char line[40];
      std::snprintf(line, sizeof line, "%d %.9g\n", static_cast<int>(bin), share);
      if (share > 0.0) lines += line;
    }
    out << YAML::Literal << lines;
  }
  out << YAML::EndSeq;
}

std::string toYaml(const AppearanceModel& model) {
  YAML::Emitter out;
  out.SetDoublePrecision(15);
  out << YAML::Comment("The appearance of one person. Colours are lines of: blue green red count.");
  out << YAML::BeginMap;
  Writer writer(out);
  writer.field(kVersionKey, kAppearanceFormat);
  visitParams(model.params(), writer);
  out << YAML::Key << "bands" << YAML::Value << YAML::BeginSeq;
  for (const AppearanceBand& band : model.bands()) {
    out << YAML::BeginMap;
    writer.field("name", band.body.name);
    writer.field("min_height_m", band.body.min_height_m);
    writer.field("max_height_m", band.body.max_height_m);
    writer.field("threshold", static_cast<int>(band.table.threshold()));
    out << YAML::Comment("of 255; a colour passes when its score is above");
    writeColors(out, band.person);
    out << YAML::EndMap;
  }
  out << YAML::EndSeq;
  if (model.stature()) {
    writer.begin("stature");
    visitStature(*model.stature(), writer);
    writer.end();
  }
  writePortrait(out, model.portrait());
  writer.begin("room");
  writeColors(out, model.room());
  writer.end();
  out << YAML::EndMap << YAML::Newline;
  return out.c_str();
}

}  // namespace

void saveAppearance(const AppearanceModel& model, const fs::path& file) {
  writeWholeFile(file, toYaml(model));
}

AppearanceModel loadAppearance(const fs::path& file) {
  const std::string name = file.string();
  YAML::Node yaml;
  try {
    yaml = YAML::LoadFile(name);
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(name + " cannot be read: " +
                             (fs::exists(file) ? "it is not a readable file" : "no such file"));
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(name + " is not YAML: line " + std::to_string(e.mark.line + 1) + ", " +
                             e.msg);
  }
  if (!yaml.IsMap() || !yaml[kVersionKey]) {
    throw std::runtime_error(name + " is not an appearance model: it has no field '" + kVersionKey +
                             "'");
  }
  try {
    return readModel(yaml);
  } catch (const std::exception& e) {
    throw std::runtime_error(name + " is not a valid appearance model: " + e.what());
  }
}

}  // namespace heel

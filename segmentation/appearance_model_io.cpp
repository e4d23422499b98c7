// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/cloud/yaml_map.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
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

/// Reads the fields of a map, which may have none but these.
class Reader {
 public:
  explicit Reader(YamlMap map) { maps_.push_back(std::move(map)); }

  void field(const char* key, double& value) { value = map().number(key); }
  void field(const char* key, bool& value) { value = map().flag(key); }
  void field(const char* key, int& value) { value = map().integer(key, 0, kMost); }
  void field(const char* key, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(map().integer(key, 0, kMost));
  }

  template <typename Enum>
  void choice(const char* key, Enum& value, const Names<Enum>& names) {
    const std::string text = map().text(key);
    for (const auto& [known, name] : names) {
      if (name == text) {
        value = known;
        return;
      }
    }
    map().fail(key, "is '" + text + "', which is not known");
  }

  void begin(const char* key) {
    std::optional<YamlMap> inner = map().map(key, key);
    if (!inner) map().fail(key, "is missing");
    maps_.push_back(std::move(*inner));
  }

  void end() {
    map().done();
    maps_.pop_back();
  }

  /// The one that is being read.
  YamlMap& map() { return maps_.back(); }

 private:
  static constexpr int kMost = 1000000000;

  std::vector<YamlMap> maps_;  // from the outermost inwards
};

ColorHistogram readColors(YamlMap& map) {
  std::istringstream lines(map.text("colors"));
  ColorHistogram colors;
  for (std::string line; std::getline(lines, line);) {
    unsigned b = 0;
    unsigned g = 0;
    unsigned r = 0;
    unsigned long long count = 0;
    char rest = 0;
    if (std::sscanf(line.c_str(), "%u %u %u %llu %c", &b, &g, &r, &count, &rest) != 4) {
      map.fail("colors", "has a line that is not 'blue green red count': '" + line + "'");
    }
    constexpr unsigned long long kMostPixels = 1000000000000000;
    if (std::max({b, g, r}) > 255 || count > kMostPixels) {
      map.fail("colors", "has a colour out of range: '" + line + "'");
    }
    colors.add(
        {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(r)},
        count);
  }
  return colors;
}

/// Format 2 had fewer bins: strong colours were all one.
constexpr int kBinsOfFormat2 = 12 * 12 * 6;
int binOfFormat2(int bin) {
  constexpr int kChroma = 12, kBrightness = 6, kBefore = (BodyDescriber::kChromaBins - kChroma) / 2;
  const int red = bin / kBrightness / kChroma + kBefore;
  const int blue = bin / kBrightness % kChroma + kBefore;
  return (red * BodyDescriber::kChromaBins + blue) * kBrightness + bin % kBrightness;
}

/// Up to format 3, four of the stripes were two.
constexpr int kStripesOfFormat3 = 8;
constexpr std::array<std::size_t, BodyDescriber::kStripes> kStripeOfFormat3 = {0, 1, 2, 3, 4,
                                                                               5, 6, 6, 7, 7};

BodyDescription readPortrait(YamlMap& map, int version) {
  const bool is_older = version <= 3;
  const std::vector<std::string> stripes =
      map.texts("portrait", is_older ? kStripesOfFormat3 : BodyDescriber::kStripes);
  BodyDescription portrait;
  portrait.colors.setZero(BodyDescriber::kBins, BodyDescriber::kStripes);
  for (std::size_t stripe = 0; stripe < kStripeOfFormat3.size(); ++stripe) {
    auto column = portrait.colors.col(static_cast<Eigen::Index>(stripe));
    std::istringstream lines(stripes[is_older ? kStripeOfFormat3[stripe] : stripe]);
    for (std::string line; std::getline(lines, line);) {
      int bin = 0;
      float share = 0.0F;
      char rest = 0;
      const bool is_read = std::sscanf(line.c_str(), "%d %f %c", &bin, &share, &rest) == 2;
      if (!is_read || bin < 0 || bin >= (version == 2 ? kBinsOfFormat2 : BodyDescriber::kBins) ||
          !(share >= 0.0F && share <= 1.0F)) {
        map.fail("portrait", "has a line that is not 'bin share': '" + line + "'");
      }
      column[version == 2 ? binOfFormat2(bin) : bin] = share;
    }
    if (column.sum() > 1.01F) {
      map.fail("portrait", "has a stripe with shares of more than 1 in all");
    }
  }
  return portrait;
}

AppearanceModel readModel(YamlMap root) {
  const int version = root.integer(kVersionKey, 1, 1000000);
  if (version > kAppearanceFormat) {
    root.fail(kVersionKey, "is " + root.text(kVersionKey) +
                               ", but this program knows only versions up to " +
                               std::to_string(kAppearanceFormat));
  }
  AppearanceParams params;
  params.bands.clear();
  std::vector<ColorHistogram> person;
  std::vector<std::uint8_t> thresholds;
  for (YamlMap& band : root.list("bands", "band")) {
    params.bands.push_back(
        {band.text("name"), band.number("min_height_m"), band.number("max_height_m")});
    thresholds.push_back(static_cast<std::uint8_t>(band.integer("threshold", 0, 255)));
    person.push_back(readColors(band));
    band.done();
  }
  BodyDescription portrait;
  if (version >= 2) portrait = readPortrait(root, version);
  const bool has_stature = root.has("stature");

  Reader reader(std::move(root));
  visitParams(params, reader);
  std::optional<Stature> stature;
  if (has_stature) {
    reader.begin("stature");
    visitStature(stature.emplace(), reader);
    reader.end();
  }
  reader.begin("room");
  const ColorHistogram room = readColors(reader.map());
  const auto pixels = static_cast<double>(room.total());
  if (reader.map().number("pixels", pixels, {0.0, 1e18}) != pixels) {
    reader.map().fail("colors", "does not hold as many pixels as it says: the file is truncated");
  }
  reader.end();
  reader.map().done();
  AppearanceModel model(std::move(params), std::move(person), room, stature, std::move(portrait));
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
  writer.field("pixels", model.room().total());  // so that a file that was cut off is known
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
  YamlMap map = YamlMap::fromFile(file, "appearance model");
  if (!map.has(kVersionKey)) {
    throw std::runtime_error(file.string() + " is not an appearance model: it has no field '" +
                             kVersionKey + "'");
  }
  try {
    return readModel(std::move(map));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + " is not a valid appearance model: " + error.what());
  }
}

}  // namespace heel

// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where results go: the one place that creates, replaces and removes files of the user's folders.
#pragma once

#include <heel/apps/output/run_end.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heel {

/// A C file that is closed.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

/// A file of the results: where it is written, and what it will be called, for messages.
struct OutputPath {
  std::filesystem::path written;
  std::filesystem::path named;

  OutputPath(std::filesystem::path while_written, std::filesystem::path in_the_end)
      : written(std::move(while_written)), named(std::move(in_the_end)) {}
  /// A file that is written in its place.
  // NOLINTNEXTLINE(google-explicit-constructor): whoever writes a file takes both kinds.
  OutputPath(const std::filesystem::path& file) : written(file), named(file) {}
};

enum class OutputKind {
  kFolder,  ///< A folder with results.
  kFile,    ///< A file, and maybe others beside it.
};

/// What a run wants to write.
struct OutputPlan {
  std::string by;  ///< Who writes: what another one made is not replaced.
  OutputKind kind = OutputKind::kFolder;
  std::filesystem::path path;                 ///< The folder or the file.
  std::vector<std::filesystem::path> inputs;  ///< What the run reads; empty ones are left out.
  std::vector<std::string> names = {};  ///< Files that it will write, as far as they are known.
  bool alone = false;                   ///< Nothing else may be in the folder.
};

/// The results of one run. They get their place at commit(), all of them at once; until then, and
/// if there is no commit, what was there before stays as it was.
///
/// They are written to a hidden folder beside their place, which is locked: a second run to the
/// same place is refused, and what a killed run left there is removed by the next one. A hidden
/// list, the manifest, names the files that were made; none but these are ever replaced or removed.
/// It also holds the facts of the run; see factsOfThisRun().
class Output {
 public:
  /// @throws std::invalid_argument  if results may not go there: an input is the same, within it or
  ///         around it; another run writes there; a file is in the way that was not made by `by`.
  /// @throws OutputError  if nothing can be written there.
  explicit Output(const OutputPlan& plan);
  /// Removes what is not committed.
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// The folder or the file, as the user named it; once committed, where it is.
  const std::filesystem::path& path() const { return plan_.path; }

  /// The file of this name in the folder, or beside the file. "left/1.png" is in a folder of its
  /// own, which is made.
  OutputPath operator/(const std::string& name) const;

  /// The file itself.
  OutputPath file() const { return *this / plan_.names.back(); }

  /// Gives the results their place. A folder that holds nothing else is exchanged whole; else file
  /// after file is. Results that are not complete do not replace complete ones: they go to a new
  /// folder beside, and so do those whose name somebody else's file has taken meanwhile.
  /// @throws OutputError  if that is not possible; it tells where the results are, if they are.
  void commit(bool complete = true);

 private:
  void refuseInputs() const;
  void refuseTaken(const std::string& name) const;
  /// Whether the place holds nothing but the manifest and what the run before made.
  bool holdsNothingElse(const std::set<std::filesystem::path>& former) const;
  void lock();
  void discard();
  std::set<std::filesystem::path> written() const;
  /// What the run before made.
  std::set<std::filesystem::path> former() const;
  void writeManifest(std::FILE* file, const std::set<std::filesystem::path>& names,
                     bool complete) const;
  bool exchange(const std::set<std::filesystem::path>& former);
  void moveEach(const std::set<std::filesystem::path>& names,
                const std::set<std::filesystem::path>& former);
  /// Leaves the results in a new folder, "NAME.1".
  void moveAside();

  OutputPlan plan_;
  std::string inputs_;                       ///< Their state when the run began, for the manifest.
  std::filesystem::path home_;               ///< The folder that the results go to.
  std::filesystem::path staging_;            ///< The hidden folder.
  std::filesystem::path manifest_;           ///< Its place in the end.
  std::vector<std::filesystem::path> made_;  ///< Folders above, the highest one last.
  OpenFile lock_;  ///< The manifest in the making. Null: nothing is pending.
};

/// What is known of the run whose results are there, as their manifest tells: see factsOfThisRun().
/// Empty: nothing that we made is there.
/// @param place  A folder or a file.
std::string factsAt(const std::filesystem::path& place);

/// Whether a run with the same call on the same inputs left its complete results there, and they
/// still are.
bool isDoneAlready(const std::filesystem::path& place);

/// A file that is written piece by piece. One that was not closed, or not written whole, is
/// removed.
class OutputFile {
 public:
  /// @throws OutputError  one sentence that names the file and the reason, for instance when the
  ///         disk is full; so do the others.
  explicit OutputFile(OutputPath path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);

  /// Ends the writing.
  void close();

 private:
  [[noreturn]] void fail();

  OutputPath path_;
  OpenFile file_;  ///< Null once closed.
};

/// Writes a whole file at once.
/// @throws OutputError  as OutputFile.
void writeFile(const OutputPath& path, std::string_view text);

/// Gives `write` the path of a file to write, and names the file as it will be called where it
/// fails.
/// @tparam Write  Throws std::runtime_error with a sentence that may name that path.
/// @throws OutputError  with that sentence; the file is removed.
template <typename Write>
void writeWith(const OutputPath& path, const Write& write) {
  try {
    write(path.written);
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    std::filesystem::remove(path.written, ignored);
    std::string why = error.what();
    const std::string shown = path.written.string();
    if (const auto at = why.find(shown); at != std::string::npos) {
      why.replace(at, shown.size(), path.named.string());
    }
    throw OutputError(why);
  }
}

}  // namespace heel

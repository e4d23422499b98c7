// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/output.hpp>
#include <heel/apps/output/run_facts.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace heel {

namespace fs = std::filesystem;

namespace {

using Names = std::set<fs::path>;

constexpr const char* kComplete = "complete";
constexpr const char* kManifest = ".heel";  // in a folder; of a file X it is .X.heel

std::string lastError() { return std::generic_category().message(errno); }

[[noreturn]] void failToWrite(const fs::path& file, const std::string& why) {
  throw OutputError(file.string() + " cannot be written: " + why);
}

fs::path resolved(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) failToWrite(path, error.message());
  return result.has_filename() ? result : result.parent_path();  // given as "name/"
}

/// Whether `path` is `folder` or below it.
bool isWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

/// Whether the way from `folder` to what is called `name` in it leads nowhere else.
bool staysWithin(const fs::path& folder, const fs::path& name) {
  if (name.empty() || name.is_absolute()) return false;
  fs::path way = folder;
  for (auto part = name.begin(); part != name.end(); ++part) {
    if (*part == ".." || fs::is_symlink(fs::symlink_status(way))) return false;
    way /= *part;
  }
  return true;
}

/// Tells the disk to keep what was written, and is told whether there was room.
void sync(const fs::path& path, const fs::path& named) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // What may not be opened, a folder of somebody else, or can't be synced is left to the system.
  const bool is_kept = file < 0 ? errno == EACCES : fsync(file) == 0 || errno == EINVAL;
  const std::string why = lastError();
  if (file >= 0) ::close(file);
  if (!is_kept) failToWrite(named, why);
}

/// Who made what a manifest lists, and the list.
struct Manifest {
  std::string by;
  bool complete = true;
  Names names;
  std::map<fs::path, std::uintmax_t> bytes;  // of the files, as far as they were written down
  std::string facts;
};

Manifest readManifest(const fs::path& file) {
  Manifest manifest;
  std::error_code ignored;
  if (!fs::is_regular_file(fs::symlink_status(file, ignored))) return manifest;
  std::ifstream in(file);
  std::string text;
  std::getline(in, text);  // for people
  in >> std::quoted(manifest.by) >> text;
  manifest.complete = text == kComplete;
  while ((in >> std::ws).peek() == '"' && in >> std::quoted(text)) {
    manifest.names.insert(text);
    if (in.peek() == ' ') in >> manifest.bytes[text];
  }
  std::getline(in, manifest.facts);
  return manifest;
}

/// The manifest of a folder or a file.
fs::path manifestOf(const fs::path& place, bool is_folder) {
  return is_folder ? place / kManifest
                   : place.parent_path() / ("." + place.filename().string() + kManifest);
}

}  // namespace

Output::Output(const OutputPlan& plan) : plan_(plan) {
  if (plan.path.empty()) throw std::invalid_argument("a result has an empty name");
  const fs::path target = resolved(plan.path);
  const fs::path parent = target.parent_path();
  const std::string name = target.filename().string();
  const bool is_folder = plan.kind == OutputKind::kFolder;
  home_ = is_folder ? target : parent;
  staging_ = parent / ("." + name + ".heel-part");
  manifest_ = manifestOf(target, is_folder);
  if (!is_folder) plan_.names.push_back(name);
  refuseInputs();

  std::error_code error;
  for (fs::path above = parent; !fs::exists(above, error) && !error; above = above.parent_path()) {
    made_.push_back(above);
  }
  fs::create_directories(parent, error);
  if (!error && is_folder && isThere(target) && !fs::is_directory(target)) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (!error && !is_folder && fs::is_directory(target)) {
    error = std::make_error_code(std::errc::is_a_directory);
  }
  if (error) failToWrite(plan.path, error.message());
  struct stat here {};
  struct stat above {};
  if (is_folder && stat(target.c_str(), &here) == 0 && stat(parent.c_str(), &above) == 0 &&
      (here.st_dev != above.st_dev || access(parent.c_str(), W_OK) != 0)) {
    staging_ = home_ / (std::string(kManifest) + "-part");  // it can't be beside
  }
  lock();
  keepResultsOnSignals();
  inputs_ = stateOfInputs(plan_.inputs);
  try {
    const Manifest manifest = readManifest(manifest_);
    const auto isStillThere = [&](const fs::path& file) { return isThere(home_ / file); };
    if (manifest.by != plan.by &&
        std::any_of(manifest.names.begin(), manifest.names.end(), isStillThere)) {
      throw std::invalid_argument(plan.path.string() + ": holds results of 'heel " + manifest.by +
                                  "', which are not replaced; name another place");
    }
    if (plan.alone && isThere(home_) && !holdsNothingElse(former())) {
      throw std::invalid_argument(plan.path.string() + ": holds something that 'heel " + plan.by +
                                  "' did not make; name another folder");
    }
    for (const std::string& file : plan_.names) refuseTaken(file);
  } catch (...) {
    discard();
    throw;
  }
}

Output::~Output() {
  if (lock_ != nullptr) discard();
}

void Output::refuseInputs() const {
  const fs::path target = resolved(plan_.path);
  for (const fs::path& input : plan_.inputs) {
    if (input.empty()) continue;
    const fs::path read = resolved(input);
    if (isWithin(target, read) || (plan_.kind == OutputKind::kFolder && isWithin(read, target))) {
      throw std::invalid_argument(plan_.path.string() + ": the results would mix with " +
                                  input.string() + ", which is read; name another place");
    }
  }
}

void Output::refuseTaken(const std::string& name) const {
  if (isThere(home_ / name) && former().count(name) == 0) {
    throw std::invalid_argument((home_ / name).string() +
                                ": is there already, and was not made by 'heel " + plan_.by +
                                "'; remove it, or name another place");
  }
}

// The lock is on the file, not on its name: whoever locked a file that has lost its name meanwhile,
// because the run that made it has ended, tries again.
void Output::lock() {
  const fs::path file = staging_ / kManifest;
  std::error_code ignored;
  const bool is_ours = !isThere(staging_) || (!fs::is_symlink(staging_, ignored) &&
                                              (isThere(file) || fs::is_empty(staging_, ignored)));
  if (!is_ours) throw std::invalid_argument(staging_.string() + ": is in the way; move it away");
  while (true) {
    if (mkdir(staging_.c_str(), 0777) != 0 && errno != EEXIST) failToWrite(plan_.path, lastError());
    const int descriptor =
        open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      if (errno == ENOENT) continue;
      failToWrite(plan_.path, lastError());
    }
    OpenFile locked(fdopen(descriptor, "r+"));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw std::invalid_argument(plan_.path.string() + ": another run writes there");
    }
    struct stat opened {};
    struct stat there {};
    if (fstat(descriptor, &opened) != 0 || stat(file.c_str(), &there) != 0 ||
        opened.st_ino != there.st_ino) {
      continue;
    }
    lock_ = std::move(locked);
    break;
  }
  // What a killed run left.
  for (const auto& entry : fs::directory_iterator(staging_)) {
    if (entry.path() != file) fs::remove_all(entry.path());
  }
  if (ftruncate(fileno(lock_.get()), 0) != 0) failToWrite(plan_.path, lastError());
}

// The manifest goes last: as long as it is there, the lock holds.
void Output::discard() {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(staging_, ignored)) {
    if (entry.path().filename() != kManifest) fs::remove_all(entry.path(), ignored);
  }
  fs::remove(staging_ / kManifest, ignored);
  fs::remove(staging_, ignored);
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // if nothing is in it
  lock_.reset();
}

OutputPath Output::operator/(const std::string& name) const {
  const fs::path file = staging_ / name;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const fs::path named =
      plan_.kind == OutputKind::kFolder ? plan_.path / name : plan_.path.parent_path() / name;
  if (error) failToWrite(named, error.message());
  return {file, named};
}

std::set<fs::path> Output::written() const {
  Names names;
  for (const auto& entry : fs::recursive_directory_iterator(staging_)) {
    const fs::path name = entry.path().lexically_relative(staging_);
    if (!entry.is_directory() && name != kManifest) names.insert(name);
  }
  return names;
}

// A manifest may come with a folder from somebody else: it is not trusted to name files elsewhere.
std::set<fs::path> Output::former() const {
  Names names;
  const Manifest manifest = readManifest(manifest_);
  if (manifest.by != plan_.by) return names;
  for (const fs::path& name : manifest.names) {
    std::error_code ignored;
    if (staysWithin(home_, name) &&
        fs::is_regular_file(fs::symlink_status(home_ / name, ignored))) {
      names.insert(name);
    }
  }
  return names;
}

void Output::writeManifest(std::FILE* file, const Names& names, bool complete) const {
  std::ostringstream text;
  text << "# Files that 'heel " << plan_.by << "' made: it replaces and removes no others.\n"
       << std::quoted(plan_.by) << ' ' << (complete ? kComplete : "incomplete") << '\n';
  for (const fs::path& name : names) {
    text << std::quoted(name.string());
    std::error_code gone;
    const std::uintmax_t bytes = fs::file_size(staging_ / name, gone);
    if (!gone) text << ' ' << bytes;
    text << '\n';
  }
  text << factsOfThisRun(inputs_) << '\n';
  if (std::fputs(text.str().c_str(), file) < 0 || std::fflush(file) != 0) {
    failToWrite(manifest_, lastError());
  }
}

void Output::commit(bool complete) {
  if (lock_ == nullptr) throw std::logic_error("Output: committed after its end");
  const Names names = written();
  writeManifest(lock_.get(), names, complete);
  for (const auto& entry : fs::recursive_directory_iterator(staging_)) {
    sync(entry.path(), home_ / entry.path().lexically_relative(staging_));
  }
  sync(staging_, plan_.path);
  const Names replaced = former();
  if (!complete && !replaced.empty() && readManifest(manifest_).complete) return moveAside();
  std::string problem;
  try {
    if (!exchange(replaced)) moveEach(names, replaced);
  } catch (const fs::filesystem_error& error) {
    problem = plan_.path.string() + " cannot be written: " + error.code().message();
  } catch (const OutputError& error) {
    problem = error.what();
  }
  if (!problem.empty()) {
    moveAside();
    throw OutputError(problem + "; the results are in " + plan_.path.string());
  }
  lock_.reset();
  std::error_code ignored;
  if (fs::is_directory(home_.parent_path(), ignored)) sync(home_.parent_path(), plan_.path);
}

bool Output::holdsNothingElse(const Names& former) const {
  Names folders;
  for (const fs::path& name : former) {
    for (fs::path above = name.parent_path(); !above.empty(); above = above.parent_path()) {
      folders.insert(above);
    }
  }
  for (const auto& entry :
       fs::recursive_directory_iterator(home_, fs::directory_options::skip_permission_denied)) {
    const fs::path name = entry.path().lexically_relative(home_);
    const bool is_folder = fs::is_directory(entry.symlink_status());
    if (isWithin(entry.path(), staging_)) continue;
    if (name != kManifest && (is_folder ? folders : former).count(name) == 0) return false;
  }
  return true;
}

bool Output::exchange(const Names& former) {
  if (plan_.kind != OutputKind::kFolder || staging_.parent_path() == home_) return false;
  if (!isThere(home_)) return ::rename(staging_.c_str(), home_.c_str()) == 0;
  std::error_code error;
  // Whoever stands in the folder would find themselves in one that is gone.
  if (isWithin(fs::current_path(error), home_)) return false;
  struct stat about {};
  if (stat(home_.c_str(), &about) != 0 || about.st_uid != geteuid()) return false;
  if (!holdsNothingElse(former)) return false;
  fs::permissions(staging_, fs::status(home_).permissions(), error);
  // Locks the former results, too: they go where another run would begin to write.
  const OpenFile former_lock(std::fopen((home_ / kManifest).c_str(), "re"));
  if (former_lock != nullptr) flock(fileno(former_lock.get()), LOCK_EX | LOCK_NB);
  if (renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, home_.c_str(), RENAME_EXCHANGE) != 0) {
    return false;
  }
  discard();
  return true;
}

void Output::moveEach(const Names& names, const Names& former) {
  for (const fs::path& name : names) {
    const fs::path place = home_ / name;
    if (!staysWithin(home_, name) || (isThere(place) && former.count(name) == 0)) {
      throw OutputError(place.string() + " is there already, and was not made by 'heel " +
                        plan_.by + "'");
    }
  }
  // Whenever the run is killed, the manifest knows all that it made.
  Names both = former;
  both.insert(names.begin(), names.end());
  const fs::path interim = staging_ / (std::string(kManifest) + "-interim");
  fs::create_directories(home_);
  {
    const OpenFile file(std::fopen(interim.c_str(), "wbe"));
    if (file == nullptr) failToWrite(manifest_, lastError());
    writeManifest(file.get(), both, false);
  }
  fs::rename(interim, manifest_);
  for (const fs::path& name : names) {
    fs::create_directories((home_ / name).parent_path());
    fs::rename(staging_ / name, home_ / name);
  }
  std::error_code ignored;
  for (const fs::path& name : former) {
    if (names.count(name) > 0) continue;
    fs::remove(home_ / name, ignored);
    for (fs::path above = name.parent_path(); !above.empty(); above = above.parent_path()) {
      fs::remove(home_ / above, ignored);  // if nothing is left in it
    }
  }
  for (const auto& entry : fs::directory_iterator(staging_)) {
    if (entry.is_directory()) fs::remove_all(entry, ignored);
  }
  fs::rename(staging_ / kManifest, manifest_);
  fs::remove(staging_, ignored);
}

void Output::moveAside() {
  const std::string name = resolved(plan_.path).filename().string();
  fs::path kept;
  for (int i = 1; kept.empty() || isThere(kept); ++i) {
    kept = staging_.parent_path() / (name + "." + std::to_string(i));
  }
  std::error_code error;
  fs::rename(staging_, kept, error);
  plan_.path = error ? staging_ : kept;
  lock_.reset();
}

std::string factsAt(const fs::path& place) {
  const fs::path target = resolved(place);
  std::error_code ignored;
  return readManifest(manifestOf(target, fs::is_directory(target, ignored))).facts;
}

bool isDoneAlready(const fs::path& place) {
  const fs::path target = resolved(place);
  std::error_code ignored;
  const bool is_folder = fs::is_directory(target, ignored);
  const Manifest manifest = readManifest(manifestOf(target, is_folder));
  const fs::path home = is_folder ? target : target.parent_path();
  return !manifest.by.empty() && manifest.complete && !manifest.names.empty() &&
         std::all_of(manifest.bytes.begin(), manifest.bytes.end(),
                     [&](const auto& file) {
                       return fs::file_size(home / file.first, ignored) == file.second;
                     }) &&
         manifest.bytes.size() == manifest.names.size() && wouldRepeat(manifest.facts);
}

OutputFile::OutputFile(OutputPath path)
    : path_(std::move(path)), file_(std::fopen(path_.written.c_str(), "wbe")) {
  if (file_ == nullptr) failToWrite(path_.named, lastError());
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (file_ != nullptr) fs::remove(path_.written, ignored);
}

void OutputFile::fail() {
  const std::string why = lastError();
  std::error_code ignored;
  fs::remove(path_.written, ignored);
  file_.reset();
  failToWrite(path_.named, why);
}

void OutputFile::write(std::string_view text) {
  if (file_ == nullptr) throw std::logic_error("OutputFile: written to after its end");
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void OutputFile::close() {
  if (file_ != nullptr && std::fclose(file_.release()) != 0) fail();
}

void writeFile(const OutputPath& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace heel

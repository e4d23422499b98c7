// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/sqlite_file.hpp>
#include <heel/cloud/files.hpp>

#include <sqlite3.h>

#include <algorithm>
#include <stdexcept>

namespace heel {

void SqliteFile::Close::operator()(sqlite3* database) const { sqlite3_close(database); }
void SqliteQuery::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

struct SqliteFile::Work {
  std::uint64_t allowed = 0;
  std::uint64_t left = 0;
};
void SqliteFile::DeleteWork::operator()(Work* work) const { delete work; }

void SqliteFile::allowWork() {
  if (work_) work_->left = work_->allowed;
}

bool SqliteFile::open(const std::string& address, int flags) {
  sqlite3* database = nullptr;
  const int result = sqlite3_open_v2(address.c_str(), &database, flags, nullptr);
  database_.reset(database);
  return result == SQLITE_OK;
}

/// Holds what is read to what the file can have in it.
void SqliteFile::guard(const std::filesystem::path& file) {
  constexpr int kStep = 1000;  // of SQLite's instructions, between two looks
  std::error_code none;
  std::uintmax_t bytes = 1U << 20U;
  for (const char* ending : {"", "-wal"}) {
    const auto size = std::filesystem::file_size(file.string() + ending, none);
    if (!none) bytes += size;
  }
  const auto longest = static_cast<int>(std::min<std::uintmax_t>(bytes, 1000000000));
  sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, longest);
  work_.reset(new Work{10000 + bytes / 20, 0});
  allowWork();
  const auto look = [](void* work) { return static_cast<Work*>(work)->left-- == 0 ? 1 : 0; };
  sqlite3_progress_handler(database_.get(), kStep, look, work_.get());
  run("PRAGMA trusted_schema = OFF");
  run("PRAGMA cell_size_check = ON");
  // A file that was cut off is refused as a whole, unless the schema is "writable".
  run("PRAGMA writable_schema = ON");
}

SqliteFile::SqliteFile(const std::filesystem::path& file, Use use) : name_(file.string()) {
  if (use == Use::kCreate) {
    if (!open(name_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE)) fail();
    return;
  }
  checkIsFile(file);
  if (!open(name_, SQLITE_OPEN_READONLY)) fail();
  guard(file);
  if (query("PRAGMA schema_version").step() == SqliteQuery::Row::kThere) return;
  // A file with a journal can't be read where nothing may be written, unless it is told to be
  // final, which it is only if there is nothing in the journal.
  std::error_code none;
  if (std::filesystem::file_size(name_ + "-wal", none) > 0 && !none) {
    throw std::runtime_error(name_ + ": it was not closed, and what is in its journal (-wal) can " +
                             "only be read where files can be written: copy both to such a folder");
  }
  std::string escaped;
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '%' || c == '?' || c == '#') {
      escaped += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    } else {
      escaped += c;
    }
  }
  if (!open("file:" + escaped + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI)) fail();
  guard(file);
}

std::string SqliteFile::problem() const {
  return database_ == nullptr ? "out of memory" : sqlite3_errmsg(database_.get());
}

void SqliteFile::fail() const { throw std::runtime_error(name_ + ": " + problem()); }

void SqliteFile::run(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

SqliteQuery SqliteFile::query(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
    fail();
  }
  return {*this, statement};
}

bool SqliteFile::hasTable(const std::string& table) {
  SqliteQuery found =
      query("SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = ?");
  found.bind(1, table);
  const auto row = found.step();
  if (row == SqliteQuery::Row::kBroken) fail();
  return row == SqliteQuery::Row::kThere;
}

void SqliteFile::close() {
  sqlite3* database = database_.release();
  if (sqlite3_close(database) != SQLITE_OK) {
    database_.reset(database);
    fail();
  }
}

SqliteQuery& SqliteQuery::bind(int parameter, std::int64_t value) {
  if (sqlite3_bind_int64(statement_.get(), parameter, value) != SQLITE_OK) file_.fail();
  return *this;
}

SqliteQuery& SqliteQuery::bind(int parameter, double value) {
  if (sqlite3_bind_double(statement_.get(), parameter, value) != SQLITE_OK) file_.fail();
  return *this;
}

SqliteQuery& SqliteQuery::bindNull(int parameter) {
  if (sqlite3_bind_null(statement_.get(), parameter) != SQLITE_OK) file_.fail();
  return *this;
}

SqliteQuery& SqliteQuery::bind(int parameter, const std::string& value) {
  if (sqlite3_bind_text64(statement_.get(), parameter, value.data(), value.size(), SQLITE_TRANSIENT,
                          SQLITE_UTF8) != SQLITE_OK) {
    file_.fail();
  }
  return *this;
}

SqliteQuery& SqliteQuery::bind(int parameter, const std::uint8_t* bytes, std::size_t size) {
  if (sqlite3_bind_blob64(statement_.get(), parameter, bytes, size, SQLITE_STATIC) != SQLITE_OK) {
    file_.fail();
  }
  return *this;
}

SqliteQuery::Row SqliteQuery::step() {
  file_.allowWork();
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return Row::kThere;
  return result == SQLITE_DONE ? Row::kEnd : Row::kBroken;
}

void SqliteQuery::run() {
  if (step() == Row::kBroken) file_.fail();
  reset();
}

void SqliteQuery::reset() { sqlite3_reset(statement_.get()); }

std::int64_t SqliteQuery::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteQuery::text(int column) const {
  const auto* text = sqlite3_column_text(statement_.get(), column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

const std::uint8_t* SqliteQuery::blob(int column, std::size_t& size) const {
  const auto* bytes =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return bytes;
}

}  // namespace heel

// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The few calls to SQLite that bags need, with errors as exceptions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace heel {

class SqliteQuery;

/// A database file that is open. One that is read may be hostile: what its schema says is not run,
/// no value may be larger than the file, and a statement ends that works on and on without a row.
class SqliteFile {
 public:
  enum class Use { kRead, kCreate };
  /// @throws std::runtime_error  one sentence that names the file.
  SqliteFile(const std::filesystem::path& file, Use use);

  /// @throws std::runtime_error  as all of this class.
  void run(const std::string& sql);
  SqliteQuery query(const std::string& sql);
  /// A table that is stored: neither a view nor what an extension makes up.
  bool hasTable(const std::string& table);
  /// Ends the use of the file; whatever could not be written is told here.
  void close();

  [[noreturn]] void fail() const;
  std::string problem() const;

  /// A row has come: the statement may work on.
  void allowWork();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  struct Work;  ///< What a statement may still do before its next row.
  struct DeleteWork {
    void operator()(Work* work) const;
  };
  bool open(const std::string& address, int flags);
  void guard(const std::filesystem::path& file);

  std::string name_;
  std::unique_ptr<Work, DeleteWork> work_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// A statement, run row by row.
class SqliteQuery {
 public:
  enum class Row { kThere, kEnd, kBroken };

  SqliteQuery(SqliteFile& file, sqlite3_stmt* statement) : file_(file), statement_(statement) {}

  SqliteQuery& bind(int parameter, std::int64_t value);
  SqliteQuery& bind(int parameter, double value);
  SqliteQuery& bind(int parameter, const std::string& value);
  /// The bytes must stay until the statement has been run.
  SqliteQuery& bind(int parameter, const std::uint8_t* bytes, std::size_t size);

  SqliteQuery& bindNull(int parameter);

  Row step();  ///< Does not throw.
  void run();  ///< For statements without rows; may be bound and run again.
  void reset();

  std::int64_t integer(int column) const;
  std::string text(int column) const;
  const std::uint8_t* blob(int column, std::size_t& size) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  SqliteFile& file_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace heel

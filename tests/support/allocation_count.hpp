// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Counts allocations, to show that a stage makes none once it is warm. A program that links
/// allocation_count.cpp has its `operator new` counted, that of its shared libraries too.
#pragma once

namespace heel::test {

/// How many allocations `operator new` has made so far.
long allocations();

}  // namespace heel::test

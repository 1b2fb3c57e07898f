// For headers that name a connection: the library itself is included in .cpp files only.
#pragma once

namespace SQLite {  // NOLINT(readability-identifier-naming): not our name
class Database;
}

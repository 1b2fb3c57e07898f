// The process that a server starts for one preparation.
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "engine/engine.h"
#include "server/preparation_messages.h"
#include "server/preparation_process.h"
#include "server/priority.h"
#include "storage/blob_codec.h"

namespace spherematch {

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool limits_memory = false;  // the sanitizer reserves far more than it uses
#else
constexpr bool limits_memory = true;
#endif

/// The first number after `key` in a file of the system; nothing where either is missing. An empty key stands for the beginning.
std::optional<std::uint64_t> number_after(const char* file, const std::string& key) {
  std::ifstream in(file);
  std::string word;
  std::uint64_t value = 0;
  while (!key.empty() && word != key) {
    if (!(in >> word)) return std::nullopt;
  }
  return in >> value ? std::optional(value) : std::nullopt;
}

/// The memory that can be had now without anybody else losing theirs.
std::optional<std::uint64_t> free_memory() {
  auto free = number_after("/proc/meminfo", "MemAvailable:");
  if (!free) return std::nullopt;
  *free = 1024 * (*free + number_after("/proc/meminfo", "SwapFree:").value_or(0));
  // In a container: the group's limit without what its programs hold. What it caches of files can be had.
  if (const auto limit = number_after("/sys/fs/cgroup/memory.max", "")) {
    const std::uint64_t held = number_after("/sys/fs/cgroup/memory.stat", "anon").value_or(0);
    *free = std::min(*free, *limit - std::min(*limit, held));
  }
  return free;
}

/// Where memory runs out, that should be an error of this preparation, or at worst its end, and neither the server's nor that of the
/// container around both.
void be_modest_with_memory() {
  std::ofstream("/proc/self/oom_score_adj") << "1000";
  const auto free = limits_memory ? free_memory() : std::nullopt;
  if (!free) return;
  const rlimit limit{.rlim_cur = *free, .rlim_max = *free};
  ::setrlimit(RLIMIT_DATA, &limit);
}

void send_text(int socket, MessageKind kind, std::string_view text) { (void)send_message(socket, kind, std::as_bytes(std::span(text))); }

/// Nothing more comes through the socket, so reading ends only when the server is gone; then nobody wants the result.
void end_with_the_server(int socket) {
  std::thread([socket] {
    (void)receive_message(socket);
    std::_Exit(EXIT_FAILURE);
  }).detach();
}

void send_result(int socket, const PreprocessedShape& shape) {
  (void)(send_message(socket, MessageKind::sphere, encode_sphere(shape.sphere)) &&
         send_message(socket, MessageKind::signals, encode_signals(shape.signals)) &&
         send_message(socket, MessageKind::eigenbasis, encode_eigenbasis(shape.eigenvalues, shape.eigenvectors)) &&
         send_message(socket, MessageKind::finished, encode_summary(shape)));
}

}  // namespace

int prepare_for_server(int socket, int threads) {
  be_modest_with_memory();
  be_nice(preparation_niceness);
  std::mutex mutex;
  try {
    const auto message = receive_message(socket);
    if (!message || message->kind != MessageKind::surface) return EXIT_FAILURE;
    end_with_the_server(socket);
    const Progress progress{.report =
                                [&](std::string_view stage, double fraction) {
                                  const std::lock_guard lock(mutex);  // stages report side by side
                                  (void)send_message(socket, MessageKind::progress, encode_report(stage, fraction));
                                },
                            .stop = {}};
    send_result(socket, preprocess(decode_surface(message->body), {}, progress, threads));
  } catch (const EngineError& error) {
    (void)send_message(socket, MessageKind::refused, encode_refusal(error));
  } catch (const std::bad_alloc&) {
    send_text(socket, MessageKind::broken, "there was not enough memory");
  } catch (const std::exception& error) {
    send_text(socket, MessageKind::broken, error.what());
  }
  // Not a return from main(): the thread above still reads.
  std::_Exit(EXIT_SUCCESS);
}

}  // namespace spherematch

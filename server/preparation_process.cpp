#include "server/preparation_process.h"

#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stop_token>
#include <utility>

#include "server/descriptor.h"
#include "server/engine_port.h"
#include "server/preparation_messages.h"
#include "storage/blob_codec.h"
#include "storage/error.h"

namespace spherematch {

namespace {

/// Two ends of a new connection.
std::pair<Descriptor, Descriptor> connection() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw PreparationLost(std::string("no socket for its process: ") + std::strerror(errno));
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// Starts the program with the socket as standard input and every other descriptor but standard error closed. Stop signals stay
/// blocked: a terminal or a supervisor sends them to the server's whole group, and it is the server that ends its preparations.
pid_t spawn(const std::string& program, int threads, int socket) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

  std::string count = std::to_string(threads);
  std::string name = "spherematch-server";
  std::string flag = preparation_argument;
  std::array<char*, 4> arguments{name.data(), flag.data(), count.data(), nullptr};
  pid_t child = -1;
  const int failure = ::posix_spawn(&child, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) throw PreparationLost(std::string("its process could not be started: ") + std::strerror(failure));
  return child;
}

/// A running preparation. Killed, where it still runs, and reaped at the end.
class Worker {
 public:
  Worker(const std::string& program, int threads) : Worker(program, threads, connection()) {}
  ~Worker() {
    kill();
    (void)how_it_ended();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] int socket() const { return socket_.get(); }

  /// Only while nobody waits in how_it_ended(): a reaped process's number may be given to another.
  void kill() const {
    if (process_ > 0) ::kill(process_, SIGKILL);
  }

  /// Waits for the end.
  std::string how_it_ended() {
    if (process_ <= 0) return {};
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (!WIFSIGNALED(status)) return "its process ended with exit code " + std::to_string(WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    const char* hint = signal == SIGKILL ? ", as happens when memory runs out" : "";
    return "its process was ended by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" + hint;
  }

 private:
  /// The worker's end is closed here, so that the worker's death ends what is read from the other.
  Worker(const std::string& program, int threads, std::pair<Descriptor, Descriptor> ends)
      : socket_(std::move(ends.first)), process_(spawn(program, threads, ends.second.get())) {}

  const Descriptor socket_;
  pid_t process_;
};

/// Listens to the worker until its last word. Nothing when it ended without one.
std::optional<PreprocessedShape> listen(int socket, const Progress& progress) {
  PreprocessedShape shape;
  while (const auto message = receive_message(socket)) {
    switch (message->kind) {
      case MessageKind::progress: {
        const ProgressReport report = decode_report(message->body);
        if (progress.report) progress.report(report.stage, report.fraction);
        break;
      }
      case MessageKind::sphere:
        shape.sphere = decode_sphere(message->body);
        break;
      case MessageKind::signals:
        shape.signals = decode_signals(message->body);
        break;
      case MessageKind::eigenbasis: {
        StoredEigenbasis basis = decode_eigenbasis(message->body);
        shape.eigenvalues = std::move(basis.eigenvalues);
        shape.eigenvectors = std::move(basis.eigenvectors);
        break;
      }
      case MessageKind::finished:
        decode_summary(message->body, shape);
        return shape;
      case MessageKind::refused:
        throw decode_refusal(message->body);
      case MessageKind::broken:
        throw PreparationLost(std::string(reinterpret_cast<const char*>(message->body.data()), message->body.size()));
      case MessageKind::surface:
        throw StorageError(StorageErrorCode::corrupt_blob, "a message for the other side");
    }
  }
  return std::nullopt;
}

}  // namespace

PreprocessedShape preprocess_apart(const std::string& program, int threads, Surface surface, const Progress& progress) {
  progress.check();
  Worker worker(program, threads);
  std::optional<PreprocessedShape> shape;
  {
    const std::stop_callback killer(progress.stop, [&worker] { worker.kill(); });
    try {
      // When the worker is gone already, listening finds out.
      (void)send_message(worker.socket(), MessageKind::surface, encode_surface(surface));
      shape = listen(worker.socket(), progress);
    } catch (const StorageError& error) {
      throw PreparationLost(std::string("its process answered with ") + error.what());
    }
  }
  progress.check();
  if (!shape) throw PreparationLost(worker.how_it_ended());
  const Eigen::Index vertices = surface.working_mesh().vertex_count();
  if (shape->sphere.rows() != vertices || shape->eigenvectors.rows() != vertices) {
    throw PreparationLost("its process answered with arrays of a wrong size");
  }
  shape->surface = std::move(surface);
  return *std::move(shape);
}

}  // namespace spherematch

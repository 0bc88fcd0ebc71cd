// Writes a take as the run goes. Every record is handed to the operating system in one piece before write() returns, with
// no buffer of our own in between: whatever kills the process, the whole frames written so far are in the file.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "brickfall/take.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace brickfall {

struct TakeWriter::Impl {
  std::string path;
  TakeHeader header;
  FrameCodec codec;
  int file = -1;
  std::uint64_t size = 0;              // bytes written and whole
  std::vector<std::uint64_t> offsets;  // of the frames
  Status state;                        // the first refusal of the system; nothing is written after it
  bool finished = false;

  Impl(std::string filePath, const TakeHeader& takeHeader)
      : path(std::move(filePath)), header(takeHeader), codec(takeHeader.bodies.size()) {}
  ~Impl() {
    if (file >= 0) ::close(file);
  }

  Error refused(const char* what) const {
    return {ErrorCode::inputOutput, path + ": cannot " + what + ": " + std::strerror(errno)};
  }

  Status append(std::span<const std::uint8_t> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        state = refused("write");
        // Back to the last whole record. Should that fail too, the reader drops the torn one by its checksum.
        [[maybe_unused]] int cut = done > 0 ? ::ftruncate(file, off_t(size)) : 0;
        return state;
      }
      done += std::size_t(count);
    }
    size += bytes.size();
    return {};
  }
};

TakeWriter::TakeWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TakeWriter::TakeWriter(TakeWriter&&) noexcept = default;
TakeWriter& TakeWriter::operator=(TakeWriter&&) noexcept = default;
TakeWriter::~TakeWriter() = default;

Result<TakeWriter> TakeWriter::create(const std::string& path, const TakeHeader& header) {
  if (Status checked = checkHeader(header); !checked) {
    return Error{checked.error().code, path + ": take header: " + checked.error().message};
  }
  auto impl = std::make_unique<Impl>(path, header);
  impl->file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (impl->file < 0) return impl->refused("create");

  ByteWriter start;
  start.append(kTakeMagic);
  start.u32(kTakeVersion);
  start.append(makeRecord(RecordType::header, encodeHeader(header)));
  if (Status written = impl->append(start.bytes()); !written) return written.error();
  return TakeWriter(std::move(impl));
}

Status TakeWriter::write(const TakeFrame& frame) {
  if (!impl_->state) return impl_->state;
  if (impl_->finished) return Error{ErrorCode::wrongState, impl_->path + ": the take is finished"};
  if (Status checked = impl_->codec.check(frame, impl_->header); !checked) {
    return Error{checked.error().code,
                 impl_->path + ": frame " + std::to_string(impl_->offsets.size()) + ": " + checked.error().message};
  }
  bool key = impl_->offsets.size() % kTakeGroupFrames == 0;
  std::uint64_t offset = impl_->size;
  Status written = impl_->append(makeRecord(RecordType::frame, impl_->codec.encode(frame, key)));
  if (written) impl_->offsets.push_back(offset);
  return written;
}

Status TakeWriter::finish(const std::string& summaryJson) {
  if (!impl_->state) return impl_->state;
  if (impl_->finished) return Error{ErrorCode::wrongState, impl_->path + ": the take is already finished"};
  ByteWriter index;
  index.varint(impl_->offsets.size());
  std::uint64_t last = 0;
  for (std::uint64_t offset : impl_->offsets) {
    index.varint(offset - last);
    last = offset;
  }
  index.text(summaryJson);
  ByteWriter end;
  end.append(makeRecord(RecordType::index, index.bytes()));
  end.u64(impl_->size);
  end.append(kTakeEndMagic);
  if (Status written = impl_->append(end.bytes()); !written) return written;
  impl_->finished = true;
  // On the disk before anybody gives it a name that says it is whole. Pipes and the like cannot, and need not.
  if (::fsync(impl_->file) != 0 && errno != EINVAL) return impl_->state = impl_->refused("write");
  int file = impl_->file;
  impl_->file = -1;
  if (::close(file) != 0) return impl_->state = impl_->refused("close");
  return {};
}

}  // namespace brickfall

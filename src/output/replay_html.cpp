// One page: the template with title, description and motion put in their places.
#include "output/base64.h"
#include "output/replay_meta.h"
#include "output/replay_template.h"
#include "output/replay_tracks.h"
#include "record/atomic_file.h"

namespace brickfall {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

// Title and a line of what it is, for who shows a link to the page.
std::string preview(const TakeReader& take, const std::string& title) {
  std::size_t bricks = 0;
  for (const TakeBody& body : take.bodies()) bricks += body.role == BodyRole::brick;
  const std::size_t count = bricks > 0 ? bricks : take.bodies().size();
  const std::string line = std::to_string(count) + (bricks > 0 ? " brick" : " bod") +
                           (bricks > 0 ? (count == 1 ? "" : "s") : (count == 1 ? "y" : "ies")) +
                           ", simulated by Brickfall: orbit, scrub, click a brick for its figures.";
  return "<meta property=\"og:title\" content=\"" + title +
         "\">\n<meta property=\"og:type\" content=\"website\">\n<meta property=\"og:description\" content=\"" + line +
         "\">\n<meta name=\"description\" content=\"" + line + "\">";
}

}  // namespace

Status writeReplayHtml(const TakeReader& take, const std::string& path, const Progress& progress) {
  if (take.frameCount() == 0) return Error{ErrorCode::invalidArgument, path + ": the take has no frames to replay"};
  Result<TakePoses> poses = readPoses(take, path, progress, 0.5);
  if (!poses) return poses.error();
  double step = replayPositionStep(*poses);
  Bytes tracks = replayTracks(*poses, step);
  if (tracks.empty()) return Error{ErrorCode::limitExceeded, path + ": the take is too large to pack into a page"};
  if (progress && !progress(0.95)) return cancelled(path);

  std::string page;
  for (std::string_view piece : replayTemplate()) page += piece;
  const TakeHeader& header = take.header();
  const std::string title = escaped(header.title.empty() ? header.scene : header.title);
  const std::pair<std::string_view, std::string> places[] = {{kTitlePlace, title},
                                                             {kPreviewPlace, preview(take, title)},
                                                             {kMetaPlace, replayMeta(take, poses->breaks, step)},
                                                             {kDataPlace, base64(tracks)}};
  AtomicFile file(path);
  if (Status opened = file.open(); !opened) return opened;
  std::size_t from = 0;
  for (const auto& [place, text] : places) {
    std::size_t at = page.find(place, from);
    if (at == std::string::npos) return Error{ErrorCode::badFormat, "replay template lacks " + std::string(place)};
    file.write(std::string_view(page).substr(from, at - from));
    file.write(text);
    from = at + place.size();
  }
  file.write(std::string_view(page).substr(from));
  if (progress && !progress(1)) return cancelled(path);
  return file.commit();
}

}  // namespace brickfall

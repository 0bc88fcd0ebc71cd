#include "viewer_core/mortar_story.h"

#include <cmath>
#include <cstdio>

namespace brickfall::viewer {

namespace {

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

std::string newtons(double force) {
  char text[40];
  std::snprintf(text, sizeof text, force >= 100 ? "%.0f N" : "%.1f N", force);
  return text;
}

std::string modeWords(const ToldBreak& told) {
  if (told.mode == MortarMode::crushing) return "crushed";
  const std::string words = told.mode == MortarMode::shear ? "sheared off" : "pulled open";
  if (told.tensionShare < 0.005 || told.shearShare < 0.005) return words;
  return words + " (energy: " + percent(told.shearShare) + " shear, " + percent(told.tensionShare) + " tension)";
}

}  // namespace

std::vector<std::string> mortarLines(const MortarCount& count, const ToldBreak* first) {
  std::vector<std::string> lines;
  if (count.all == 0 && !first) return lines;
  lines.push_back(count.hold > 0 ? std::to_string(count.hold) + " of " + std::to_string(count.all) +
                                       " joints hold, used up to " + percent(count.utilisation)
                                 : "None of " + std::to_string(count.all) + " joints holds");
  if (!first) return lines;
  char time[40];
  std::snprintf(time, sizeof time, "%.2f s: ", first->time);
  lines.push_back("Why it fell: " + (time + ("mortar of " + first->bodyA)) + " and " + first->bodyB +
                  " gave way first, " + modeWords(*first) + ". It had borne " + newtons(first->force) + ".");
  for (const ToldBreak::Taker& taker : first->takers)
    lines.push_back("Its load went to " + std::string(taker.contact ? "contact of " : "mortar of ") + taker.bodyA +
                    " and " + taker.bodyB + ": " + newtons(taker.before) + " to " + newtons(taker.after));
  if (first->takers.empty()) lines.push_back("Nothing beside it bore more afterwards");
  return lines;
}

}  // namespace brickfall::viewer

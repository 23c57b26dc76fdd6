// Separate from the tests, because Xlib's macros clash with GoogleTest.
#include "FileDrag.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <cctype>
#include <cstring>
#include <stdexcept>

namespace hybrid_slam::test {
namespace {

constexpr long kVersion = 5;

/// Returns the list with this file, percent-encoded.
std::string uriListOf(const std::string& file) {
  std::string list = "file://";
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::strchr("/._-~", c)) {
      list += c;
    } else {
      constexpr char kDigits[] = "0123456789ABCDEF";
      list += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return list + "\r\n";
}

}  // namespace

struct FileDrag::Drag {
  explicit Drag(const std::string& file) : list(uriListOf(file)), display(XOpenDisplay(nullptr)) {
    if (!display) throw std::runtime_error("no X display");
  }
  ~Drag() {
    if (target != None && !isDropped) send("XdndLeave", 0);
    XCloseDisplay(display);
  }
  Drag(const Drag&) = delete;
  Drag& operator=(const Drag&) = delete;

  Atom atom(const char* name) const { return XInternAtom(display, name, False); }

  /// Returns the first item of a window's property of 32-bit items; 0 if it has none.
  unsigned long itemOf(Window of, const char* name) const {
    Atom type = None;
    int format = 0;
    unsigned long count = 0, left = 0, item = 0;
    unsigned char* value = nullptr;
    XGetWindowProperty(display, of, atom(name), 0, 1, False, AnyPropertyType, &type, &format, &count, &left,
                       &value);
    if (value && format == 32 && count == 1) std::memcpy(&item, value, sizeof item);
    if (value) XFree(value);
    return item;
  }

  void send(const char* message, long first, long second = 0, long third = 0, long fourth = 0) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    const long data[] = {static_cast<long>(source), first, second, third, fourth};
    std::memcpy(event.xclient.data.l, data, sizeof data);
    XSendEvent(display, target, False, NoEventMask, &event);
  }

  void begin() {
    const Window root = DefaultRootWindow(display);
    target = itemOf(root, "_NET_ACTIVE_WINDOW");
    if (target == None || itemOf(target, "XdndAware") < static_cast<unsigned long>(kVersion))
      throw std::runtime_error("the window that has the keyboard does not know XDND");
    source = XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, 0, 0);  // never shown
    XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);
    send("XdndEnter", kVersion << 24, static_cast<long>(atom("text/uri-list")));
    moveToTheMiddle();
    XFlush(display);
  }

  void moveToTheMiddle() const {
    XWindowAttributes size{};
    XGetWindowAttributes(display, target, &size);
    int x = 0, y = 0;
    Window child = None;
    XTranslateCoordinates(display, target, size.root, size.width / 2, size.height / 2, &x, &y, &child);
    send("XdndPosition", 0, static_cast<long>(x) << 16 | y, CurrentTime,
         static_cast<long>(atom("XdndActionCopy")));
  }

  void take(const XClientMessageEvent& message) {
    const bool isAccepted = (message.data.l[1] & 1) != 0;
    if (message.message_type == atom("XdndFinished")) {
      isOver = true;
      isTaken = isAccepted;
    }
    if (message.message_type != atom("XdndStatus") || isDropped) return;
    if (!isAccepted) return moveToTheMiddle();
    isDropped = true;
    send("XdndDrop", 0, CurrentTime);
  }

  /// Gives the window the list of files.
  void answer(const XSelectionRequestEvent& request) const {
    const bool isList = request.target == atom("text/uri-list");
    if (isList)
      XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(list.data()), static_cast<int>(list.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = isList ? request.property : None;
    event.xselection.time = request.time;
    XSendEvent(display, request.requestor, False, NoEventMask, &event);
  }

  std::string list;
  Display* display;
  Window source = None, target = None;
  bool isDropped = false, isOver = false, isTaken = false;
};

FileDrag::FileDrag(const std::string& file) : drag_(std::make_unique<Drag>(file)) { drag_->begin(); }

FileDrag::~FileDrag() = default;

bool FileDrag::isOver() {
  while (XPending(drag_->display) > 0) {
    XEvent event{};
    XNextEvent(drag_->display, &event);
    if (event.type == ClientMessage) drag_->take(event.xclient);
    if (event.type == SelectionRequest) drag_->answer(event.xselectionrequest);
  }
  XFlush(drag_->display);
  return drag_->isOver;
}

bool FileDrag::isTaken() const { return drag_->isTaken; }

}  // namespace hybrid_slam::test

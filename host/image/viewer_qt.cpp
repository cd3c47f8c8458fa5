#include "image/viewer_qt.h"

#ifdef DEFRAY_QT
#include <QApplication>
#include <QGraphicsView>
#include <QWheelEvent>
#endif

namespace defray {

#ifdef DEFRAY_QT

struct QtViews::Filter : QObject {
  std::function<void(int, bool)> on_wheel;

  bool eventFilter(QObject* object, QEvent* event) override {
    if (event->type() != QEvent::Wheel) return QObject::eventFilter(object, event);
    const auto& wheel = static_cast<const QWheelEvent&>(*event);
    on_wheel(wheel.angleDelta().y() > 0 ? 1 : -1, wheel.modifiers() & Qt::ControlModifier);
    return true;
  }
};

QtViews::QtViews(std::function<void(int, bool)> on_wheel) : filter_(std::make_unique<Filter>()) {
  filter_->on_wheel = std::move(on_wheel);
  if (!qApp) return;
  for (QWidget* window : QApplication::topLevelWidgets()) {
    for (QGraphicsView* view : window->findChildren<QGraphicsView*>()) {
      view->setFocusPolicy(Qt::NoFocus);
      view->viewport()->setFocusPolicy(Qt::NoFocus);
      view->clearFocus();
      view->viewport()->installEventFilter(filter_.get());
    }
  }
}

#else

struct QtViews::Filter {};
QtViews::QtViews(std::function<void(int, bool)>) {}

#endif

QtViews::~QtViews() = default;

}  // namespace defray

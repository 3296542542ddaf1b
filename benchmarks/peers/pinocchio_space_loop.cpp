// A tree of revolute joints in Pinocchio: its articulated-body algorithm, and one step of Newmark (1/4, 1/2) about it.
#include <Eigen/Core>
#include <ctime>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody.hpp>

namespace {

using Vector = Eigen::VectorXd;
using Given = Eigen::Map<const Vector>;
using Place = Eigen::Map<const Eigen::Vector3d>;
using Rows = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

constexpr int OF_A_JOINT = 22; // place (3), turn (9), mass, centre (3), inertia xx yy zz xy xz yz

pinocchio::Model made(int n, const int *host, const int *axis, const double *numbers, const double *gravity)
{
    pinocchio::Model model;
    model.gravity.linear() = Place(gravity);
    std::vector<pinocchio::JointIndex> made(n);
    for (int j = 0; j < n; ++j) {
        const double *own = numbers + OF_A_JOINT * j;
        const pinocchio::SE3 there(Rows(own + 3), Place(own));
        const pinocchio::JointIndex parent = host[j] ? made[host[j] - 1] : 0;
        const std::string name = "joint" + std::to_string(j);
        made[j] = axis[j] == 0 ? model.addJoint(parent, pinocchio::JointModelRX(), there, name)
            : axis[j] == 1     ? model.addJoint(parent, pinocchio::JointModelRY(), there, name)
                               : model.addJoint(parent, pinocchio::JointModelRZ(), there, name);
        const double *i = own + 16;
        const pinocchio::Symmetric3 about(i[0], i[3], i[1], i[4], i[5], i[2]);
        model.appendBodyToJoint(made[j], pinocchio::Inertia(own[12], Place(own + 13), about), pinocchio::SE3::Identity());
    }
    return model;
}

} // namespace

// As in pinocchio_loop.cpp.
extern "C" double peer_seconds(int n, const int *host, const int *axis, const double *numbers, const double *gravity,
    const double *joint, const double *torque, double step, int in_world, double *x, long steps)
{
    pinocchio::Model model = made(n, host, axis, numbers, gravity);
    const Given stiffness(joint, n), damping(joint + n, n), slack(joint + 2 * n, n), rotors(joint + 3 * n, n);
    const Given given(torque, n);
    const auto frame = in_world ? pinocchio::Convention::WORLD : pinocchio::Convention::LOCAL;
    Eigen::Map<Vector> angle(x, n), rate(x + n, n), last(x + 2 * n, n);
    if (steps == 0) {
        model.armature = rotors;
        pinocchio::Data data(model);
        const Vector exerted = given - stiffness.cwiseProduct(angle - slack) - damping.cwiseProduct(rate);
        last = pinocchio::aba(model, data, angle, rate, exerted, frame);
        return 0.0;
    }
    const double h = step, half = 0.5 * step, quarter = 0.25 * step * step;
    model.armature = rotors + half * damping + quarter * stiffness;
    pinocchio::Data data(model);
    Vector exerted(n), ahead(n), rate_ahead(n), without(n), rate_without(n);
    timespec begin, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (long k = 0; k < steps; ++k) {
        rate_ahead = rate + h * last;
        ahead = angle + h * (rate + half * last);
        without = ahead - quarter * last;
        rate_without = rate_ahead - half * last;
        exerted = given - stiffness.cwiseProduct(without - slack) - damping.cwiseProduct(rate_without);
        last = pinocchio::aba(model, data, ahead, rate_ahead, exerted, frame);
        angle = without + quarter * last;
        rate = rate_without + half * last;
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (end.tv_sec - begin.tv_sec) + 1e-9 * (end.tv_nsec - begin.tv_nsec);
}

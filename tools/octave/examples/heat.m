function x = heat()
%HEAT  Heat on a triangle mesh: its cotangent Laplacian, a full solve, local solves, distances.
%
%   x = heat() returns the heat of a source after a short time, in all vertices, and prints what
%   takes how long. In your program V and F come from a mesh file; gptoolbox has cotmatrix and
%   massmatrix, of the same signs.

    [V, F] = hills(200);
    L = cotangent_laplacian(V, F); % negative semidefinite
    M = barycentric_mass(V, F);
    n = size(V, 1);
    h = mean(sqrt(sum((V(F(:, 1), :) - V(F(:, 2), :)).^2, 2)));
    A = M - h^2 * L;

    tic;
    factor = sparse_local(A, 'definite', true);
    seconds_factor = toc;

    source = round(n / 2);
    b = zeros(n, 1);
    b(source) = 1;
    tic;
    x = factor \ b; % everywhere
    seconds_full = toc;

    near = unique(F(any(F == source, 2), :)); % the source and its neighbors
    plan = factor.plan(source, near);
    tic;
    y = plan.solve(1); % there only
    seconds_local = toc;

    fprintf('%d vertices: factor %.1f ms, all of x %.2f ms, %d vertices of x %.3f ms\n', n, ...
            1000 * seconds_factor, 1000 * seconds_full, numel(near), 1000 * seconds_local);
    if any(abs(y - x(near)) > 1e-12 * max(x)) || any(x < 0) || x(source) < max(x)
        error('heat:wrong', 'heat is largest at its source, and local solves agree with full ones');
    end

    % heat from each vertex to itself: the diagonal of the inverse, without n solves
    d = factor.diagonal(near);
    if abs(d(near == source) - x(source)) > 1e-10 * x(source)
        error('heat:diagonal', 'an entry of the inverse is that of a solve');
    end

    % a harmonic function between two vertices: rows fixed at values, b = 0 in the others
    fixed = [1; n];
    z = min_quad_with_fixed(-L, [], fixed, [0; 1]);
    if min(z) < -1e-9 || max(z) > 1 + 1e-9
        error('heat:harmonic', 'a harmonic function is between its values at the boundary');
    end
end

function L = cotangent_laplacian(V, F)
    % L(i, j) is half the sum of the cotangents opposite to the edge; rows sum to 0.
    n = size(V, 1);
    L = sparse(n, n);
    for k = 1:3
        p = F(:, k);
        q = F(:, mod(k, 3) + 1);
        r = F(:, mod(k + 1, 3) + 1);
        u = V(q, :) - V(p, :);
        v = V(r, :) - V(p, :);
        w = sum(u .* v, 2) ./ (2 * sqrt(sum(cross(u, v, 2).^2, 2)));
        L = L + sparse([q; r], [r; q], [w; w], n, n) - sparse([q; r], [q; r], [w; w], n, n);
    end
end

function M = barycentric_mass(V, F)
    % A third of the area of each triangle at each of its corners.
    n = size(V, 1);
    N = cross(V(F(:, 2), :) - V(F(:, 1), :), V(F(:, 3), :) - V(F(:, 1), :), 2);
    area = sqrt(sum(N.^2, 2)) / 2;
    M = sparse(F(:), F(:), repmat(area / 3, 3, 1), n, n);
end

function [V, F] = hills(side)
    % A square of side x side vertices over some hills.
    [x, y] = meshgrid(linspace(0, 1, side), linspace(0, 1, side));
    V = [x(:), y(:), 0.1 * sin(5 * x(:)) .* cos(4 * y(:))];
    k = reshape(1:side^2, side, side);
    a = k(1:end - 1, 1:end - 1);
    b = k(2:end, 1:end - 1);
    c = k(2:end, 2:end);
    d = k(1:end - 1, 2:end);
    F = [a(:), c(:), b(:); a(:), d(:), c(:)];
end
